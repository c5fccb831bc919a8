# docs/stability.md, the sentences of its sweeps, and the pictures that it links, as a table of strings in a C++ source:
# cmake -D OUTPUT=atlas_files.cpp -D SOURCE=. -P embed_atlas.cmake
set(document docs/stability.md)
set(sweeps reports/published/sweeps/README.md)
file(READ ${SOURCE}/${document} text)
# Without the link's bracket: an unbalanced one keeps a list from being split.
string(REGEX MATCHALL "\\([^()# ]+[.](svg|png)\\)" links "${text}")
set(names ${document} ${sweeps})
foreach(link IN LISTS links)
  string(REGEX REPLACE "^.(.*).$" "\\1" link "${link}")
  cmake_path(SET name NORMALIZE "docs/${link}")
  list(APPEND names ${name})
endforeach()
list(REMOVE_DUPLICATES names)
set(table "")
foreach(name IN LISTS names)
  if(name MATCHES "[.]png$")
    file(READ ${SOURCE}/${name} content HEX)
    string(REGEX REPLACE "(..)" "\\\\x\\1" content "${content}")
    string(APPEND table "    {\"${name}\", \"${content}\"sv},\n")
  else()
    file(READ ${SOURCE}/${name} content)
    string(APPEND table "    {\"${name}\", R\"crossray_atlas(${content})crossray_atlas\"sv},\n")
  endif()
endforeach()
file(WRITE ${OUTPUT}.new "// Generated from ${document} by cmake/embed_atlas.cmake.
#include \"harness/report/atlas.h\"

namespace crossray {

namespace {

using namespace std::string_view_literals;

constexpr AtlasFile kFiles[] = {
${table}};

} // namespace

std::span<const AtlasFile> atlasFiles()
{
    return kFiles;
}

} // namespace crossray
")
file(COPY_FILE ${OUTPUT}.new ${OUTPUT} ONLY_IF_DIFFERENT)
