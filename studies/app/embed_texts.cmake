cmake_minimum_required(VERSION 3.25)
# Writes OUTPUT with every <name><ENDING> of FILES as a string, which FUNCTION gives.
set(rows "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  string(REPLACE "${ENDING}" "" name "${name}")
  file(READ "${file}" text)
  string(APPEND rows "    {\"${name}\", R\"embedded(${text})embedded\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"embedded_text.hpp\"

namespace flexspline::app {

std::span<const EmbeddedText> ${FUNCTION}() {
  static constexpr EmbeddedText rows[] = {
${rows}  };
  return rows;
}

}  // namespace flexspline::app
")
