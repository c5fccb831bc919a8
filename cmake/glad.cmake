# The GL loader, generated from Debian's python3-glad (glad 2): libepoxy aborts under OSMesa and glbinding returns null.
find_program(python3_of_debian python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED) # the interpreter that sees python3-glad
set(glad_dir ${CMAKE_BINARY_DIR}/glad)
add_custom_command(
  OUTPUT ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h
  COMMAND ${python3_of_debian} -m glad --reproducible --extensions "" --api gl:core=4.5 --out-path ${glad_dir} --quiet c
  VERBATIM)
add_library(glad STATIC ${glad_dir}/src/gl.c)
target_include_directories(glad SYSTEM PUBLIC ${glad_dir}/include)
