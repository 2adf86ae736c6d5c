# Writes OUTPUT, a C++ file with the text of every file of FOLDER, for report/page_files.hpp.
file(GLOB files ${FOLDER}/*.html ${FOLDER}/*.css ${FOLDER}/*.js)
set(entries "")
foreach(path ${files})
  get_filename_component(name ${path} NAME)
  file(READ ${path} text)
  string(APPEND entries "  if (name == \"${name}\")\n    return R\"dimpage(${text})dimpage\";\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"report/page_files.hpp\"\n\n#include \"base/error.hpp\"\n\nnamespace dim {\n\n\
std::string_view page_file(std::string_view name) {\n${entries}\
  throw InternalError(\"no such file of the report's page\");\n}\n\n}  // namespace dim\n")
