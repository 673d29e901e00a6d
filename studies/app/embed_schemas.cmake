cmake_minimum_required(VERSION 3.25)
# Writes OUTPUT with every data/schemas/<name>.schema.json as a string, for the command `schema`.
set(rows "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME)
  string(REPLACE ".schema.json" "" name "${name}")
  file(READ "${file}" text)
  string(APPEND rows "    {\"${name}\", R\"schema(${text})schema\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"schemas.hpp\"

namespace flexspline::app {

std::span<const SchemaText> schemas() {
  static constexpr SchemaText rows[] = {
${rows}  };
  return rows;
}

}  // namespace flexspline::app
")
