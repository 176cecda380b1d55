# Makes a C++ source of files: with NAMES a.js,b.css and FILES x,y the function embedded_file(name), which returns their bytes.
string(REPLACE "," ";" names "${NAMES}")
string(REPLACE "," ";" files "${FILES}")
set(arrays "")
set(cases "")
foreach(name file IN ZIP_LISTS names files)
  file(READ "${file}" bytes HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(MAKE_C_IDENTIFIER "${name}" array)
  string(APPEND arrays "static const unsigned char ${array}[] = {\n${bytes}};\n")
  string(APPEND cases "    if (name == \"${name}\") return {reinterpret_cast<const char*>(${array}), sizeof ${array}};\n")
endforeach()
file(WRITE "${OUTPUT}" "#include \"apps/output/pages/page.h\"\n\n#include <stdexcept>\n\nnamespace neumann {\n\n${arrays}\n"
  "std::string_view embedded_file(std::string_view name) {\n${cases}"
  "    throw std::logic_error(\"embedded_file: there is no \" + std::string(name));\n}\n\n}  // namespace neumann\n")
