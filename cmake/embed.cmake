# Files as a table of strings in a C++ source: cmake -D OUTPUT=web_files.cpp -D FOLDER=harness/report/web -P embed.cmake
file(GLOB names RELATIVE ${FOLDER} ${FOLDER}/*.html ${FOLDER}/*.css ${FOLDER}/*.js)
list(SORT names)
set(table "")
foreach(name IN LISTS names)
  file(READ ${FOLDER}/${name} content)
  string(APPEND table "    {\"${name}\", R\"crossray_web(${content})crossray_web\"},\n")
endforeach()
file(WRITE ${OUTPUT}.new "// Generated from ${FOLDER_NAME} by cmake/embed.cmake.
#include \"harness/report/web_files.h\"

namespace crossray {

namespace {

constexpr WebFile kFiles[] = {
${table}};

} // namespace

std::span<const WebFile> webFiles()
{
    return kFiles;
}

} // namespace crossray
")
file(COPY_FILE ${OUTPUT}.new ${OUTPUT} ONLY_IF_DIFFERENT)
