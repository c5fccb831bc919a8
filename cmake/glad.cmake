# The GL loader and the EGL declarations, generated from Debian's python3-glad (glad 2): libepoxy aborts under OSMesa and
# glbinding returns null. EGL is loaded at run time, so its headers are all that is taken from there.
find_program(python3_of_debian python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED) # the interpreter that sees python3-glad
set(glad_dir ${CMAKE_BINARY_DIR}/glad)
add_custom_command(
  OUTPUT ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h ${glad_dir}/include/glad/egl.h
  COMMAND ${python3_of_debian} -m glad --reproducible
          --extensions EGL_KHR_no_config_context,EGL_MESA_platform_surfaceless
          --api gl:core=4.5,egl=1.5 --out-path ${glad_dir} --quiet c
  DEPENDS ${CMAKE_CURRENT_LIST_FILE}
  VERBATIM)
add_library(glad STATIC ${glad_dir}/src/gl.c ${glad_dir}/include/glad/gl.h ${glad_dir}/include/glad/egl.h)
target_include_directories(glad SYSTEM PUBLIC ${glad_dir}/include)
