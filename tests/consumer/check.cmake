# Installs the package below a prefix of its own, then configures and builds the consumer against it. The prefix is moved once
# before: nothing in the package may know where it was installed.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/installed --component shaders)
file(RENAME ${SCRATCH}/installed ${SCRATCH}/moved)

run(${CMAKE_COMMAND} -G Ninja -S ${CONSUMER} -B ${SCRATCH}/build -D CMAKE_PREFIX_PATH=${SCRATCH}/moved)
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
foreach(variant vulkan opengl)
  if(NOT EXISTS ${SCRATCH}/build/water_${variant}.spv)
    message(FATAL_ERROR "no water_${variant}.spv was built")
  endif()
endforeach()

# Another version is no match: the package says which it is.
execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -S ${CONSUMER} -B ${SCRATCH}/wrong -D CMAKE_PREFIX_PATH=${SCRATCH}/nowhere
                RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
if(code EQUAL 0)
  message(FATAL_ERROR "the consumer found a package other than the one that was installed")
endif()
file(READ ${SCRATCH}/moved/share/cmake/crossray/crossray-config-version.cmake text)
if(NOT text MATCHES "PACKAGE_VERSION \"${VERSION}\"")
  message(FATAL_ERROR "the package does not say version ${VERSION}")
endif()
file(REMOVE_RECURSE ${SCRATCH})
