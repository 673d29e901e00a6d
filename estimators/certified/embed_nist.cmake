cmake_minimum_required(VERSION 3.25)
# Writes OUTPUT with every certified/nist/<name>.dat as a string.
set(rows "")
foreach(file IN LISTS FILES)
  get_filename_component(name "${file}" NAME_WE)
  file(READ "${file}" text)
  string(APPEND rows "      {\"${name}\", R\"nist(${text})nist\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"certified/nist_data.hpp\"

namespace flexspline::estimators::certified {

const std::vector<NistText>& nist_texts() {
  static const std::vector<NistText> texts = {
${rows}  };
  return texts;
}

}  // namespace flexspline::estimators::certified
")
