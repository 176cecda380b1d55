# Makes a C++ source of files: with NAMES a,b and FILES x,y the functions embedded::a() and embedded::b(), which return their bytes.
string(REPLACE "," ";" names "${NAMES}")
string(REPLACE "," ";" files "${FILES}")
set(source "#include \"apps/embedded.h\"\n\nnamespace neumann::embedded {\n")
foreach(name file IN ZIP_LISTS names files)
  file(READ "${file}" bytes HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" bytes "${bytes}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${bytes}")
  string(APPEND source "\nstatic const unsigned char ${name}_bytes[] = {\n${bytes}};\n"
    "std::string_view ${name}() { return {reinterpret_cast<const char*>(${name}_bytes), sizeof ${name}_bytes}; }\n")
endforeach()
file(WRITE "${OUTPUT}" "${source}\n}  // namespace neumann::embedded\n")
