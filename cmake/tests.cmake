# Unit tests: one program a folder of tests/unit, which links the module of the same name and so only what lies below it.
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
include(GoogleTest)

function(crossray_test_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;USES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_USES} GTest::gtest GTest::gtest_main rapidcheck)
  target_compile_definitions(${name} PRIVATE CROSSRAY_SOURCE_DIR="${CMAKE_SOURCE_DIR}" CROSSRAY_BINARY_DIR="${CMAKE_BINARY_DIR}")
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()

foreach(module base scene compile backend backend_cpu backend_vulkan backend_gl judge case expect pass run bench cli)
  file(GLOB test_sources CONFIGURE_DEPENDS tests/unit/${module}/*_test.cpp)
  if(test_sources AND TARGET crossray_${module})
    crossray_test_program(test_${module} SOURCES ${test_sources} USES crossray_${module})
  endif()
endforeach()

# The shader library as C++: each file once in float and once in double.
file(GLOB shader_test_sources CONFIGURE_DEPENDS tests/shader/*_test.cpp)
if(shader_test_sources AND TARGET crossray_backend_cpu)
  crossray_test_program(test_shader SOURCES ${shader_test_sources} USES crossray_backend_cpu)
endif()
