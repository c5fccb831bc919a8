# Unit tests: one program a folder of tests/unit, which links the module of the same name and so only what lies below it.
find_package(GTest REQUIRED)
find_package(rapidcheck REQUIRED)
include(GoogleTest)

function(crossray_test_program name)
  cmake_parse_arguments(arg "OWN_HEADERS" "PREFIX" "SOURCES;USES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_USES} GTest::gtest GTest::gtest_main rapidcheck)
  # Paths relative to the build folder, in which the tests run: so a compiler cache serves every checkout.
  file(RELATIVE_PATH source_dir ${CMAKE_BINARY_DIR} ${CMAKE_SOURCE_DIR})
  target_compile_definitions(${name} PRIVATE CROSSRAY_SOURCE_DIR="${source_dir}" CROSSRAY_BINARY_DIR=".")
  if(NOT arg_OWN_HEADERS)
    crossray_precompile(${name} test_base <gtest/gtest.h>)
    crossray_unity_build(${name})
  endif()
  target_compile_options(${name} PRIVATE -O1) # the tests themselves need no speed; what they test has its own flags
  if(CROSSRAY_PRECOMPILE AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # Out of a precompiled header GCC 12 warns of std::string, which is silent where the header is read as a system's.
    target_compile_options(${name} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
    # And of fixtures in unnamed namespaces, where a test's file is not the compiler's first.
    target_compile_options(${name} PRIVATE -Wno-subobject-linkage)
  endif()
  gtest_discover_tests(${name} TEST_PREFIX "${arg_PREFIX}" WORKING_DIRECTORY ${CMAKE_BINARY_DIR} DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT 900)
endfunction()

foreach(module base scene compile backend backend_cpu backend_vulkan backend_gl judge case expect pass run bench inspect inspector report sweep mutate cli)
  file(GLOB test_sources CONFIGURE_DEPENDS tests/unit/${module}/*_test.cpp)
  if(test_sources AND TARGET crossray_${module})
    crossray_test_program(test_${module} SOURCES ${test_sources} USES crossray_${module})
  endif()
endforeach()
if(TARGET test_pass) # jobs are run on a device that needs no driver
  target_link_libraries(test_pass PRIVATE crossray_backend_cpu)
endif()

# The OpenGL tests once more on each other way to a context: a process opens one driver.
if(TARGET test_backend_gl)
  foreach(backend softpipe egl)
    gtest_discover_tests(test_backend_gl TEST_PREFIX ${backend}. DISCOVERY_TIMEOUT 60
                         PROPERTIES TIMEOUT 300 ENVIRONMENT CROSSRAY_GL_BACKEND=${backend})
  endforeach()
endif()

# The tests of the worker pool start workers whose device misbehaves on demand.
if(TARGET test_run)
  add_executable(worker_program tests/unit/run/worker_program.cpp tests/unit/run/dying_worker.cpp)
  target_link_libraries(worker_program PRIVATE crossray_run)
  target_sources(test_run PRIVATE tests/unit/run/dying_worker.cpp)
  add_dependencies(test_run worker_program)
  if(TARGET test_inspector)
    add_dependencies(test_inspector worker_program)
  endif()
endif()

# What holds over any image, on each driver.
file(GLOB property_test_sources CONFIGURE_DEPENDS tests/property/*.cpp)
if(TARGET test_run)
  crossray_test_program(test_property SOURCES ${property_test_sources} USES crossray_run PREFIX property.)
  add_dependencies(test_property worker_program)
endif()

# Each situation in which methods fail: the case of the suite catches the naive form of the function.
if(TARGET crossray_run)
  crossray_test_program(test_stability SOURCES tests/stability/naive_shader.cpp tests/stability/stability_test.cpp
                        USES crossray_run PREFIX stability.)
  add_dependencies(test_stability worker_program)
endif()

# Random cases from the schema, on several drivers.
file(GLOB fuzz_test_sources CONFIGURE_DEPENDS tests/fuzz/*.cpp)
if(TARGET test_run)
  crossray_test_program(test_fuzz SOURCES ${fuzz_test_sources} USES crossray_run PREFIX fuzz.)
  add_dependencies(test_fuzz worker_program crossray)
endif()

# The shader library as C++: the same tests once in float and once in double, and the same .glsl files that ship.
file(GLOB shader_test_sources CONFIGURE_DEPENDS tests/shader/*_test.cpp)
foreach(precision 32 64)
  crossray_test_program(test_shader${precision} SOURCES ${shader_test_sources} USES crossray_base PREFIX cpu${precision}. OWN_HEADERS)
  target_compile_definitions(test_shader${precision} PRIVATE CROSSRAY_GLSL_PRECISION=${precision})
  # GLM with swizzles takes ten seconds to parse. The option lets compiler caches see through precompiled headers.
  target_precompile_headers(test_shader${precision} PRIVATE ${CMAKE_SOURCE_DIR}/tests/shader/shader_test.h
                            ${CMAKE_SOURCE_DIR}/harness/backend/cpu/glsl_glm.h)
  target_compile_options(test_shader${precision} PRIVATE -fpch-preprocess)
endforeach()
target_compile_options(test_shader32 PRIVATE -fsingle-precision-constant)
# How good its tracer is, on the harness's random rooms.
if(TARGET crossray_scene)
  crossray_test_program(test_yardstick SOURCES tests/shader/yardstick/hiz.cpp tests/shader/yardstick/yardstick_test.cpp
                        USES crossray_scene OWN_HEADERS)
  set_source_files_properties(tests/shader/yardstick/hiz.cpp PROPERTIES COMPILE_OPTIONS -fsingle-precision-constant)
endif()
# And as GLSL.
file(GLOB glsl_test_sources CONFIGURE_DEPENDS tests/shader/glsl/*.cpp)
crossray_test_program(test_shader_glsl SOURCES ${glsl_test_sources} USES crossray_compile crossray_case)

# What holds times to bounds has the processors to itself. Its tests are known once they are discovered.
file(WRITE ${CMAKE_BINARY_DIR}/serial_tests.cmake
     "set_tests_properties(LatencyTest.aRenderOf256By256IsThereBeforeItIsMissed LatencyTest.aTraceFollowsTheMouse PROPERTIES RUN_SERIAL ON)\n")
set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_BINARY_DIR}/serial_tests.cmake)

# The binary from outside.
file(GLOB cli_test_sources CONFIGURE_DEPENDS tests/cli/*.cpp)
if(cli_test_sources AND TARGET crossray)
  crossray_test_program(test_program SOURCES ${cli_test_sources} USES crossray_options PREFIX cli.)
  target_link_libraries(test_program PRIVATE nlohmann_json::nlohmann_json pugixml::pugixml)
  add_dependencies(test_program crossray)
endif()

# The pages in a browser that node drives; the script says what is missing where they are skipped.
file(GLOB browser_tests CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/tests/web/browser tests/web/browser/*.test.mjs)
if(NOT TARGET crossray_inspector)
  list(FILTER browser_tests EXCLUDE REGEX ^inspector)
endif()
foreach(file ${browser_tests})
  string(REPLACE .test.mjs "" name ${file})
  add_test(NAME browser.${name} COMMAND ${CMAKE_SOURCE_DIR}/tests/web/browser/run.sh ${CMAKE_BINARY_DIR} ${file})
  set_tests_properties(browser.${name} PROPERTIES TIMEOUT 600 SKIP_RETURN_CODE 77)
  if(name MATCHES speed)
    set_tests_properties(browser.${name} PROPERTIES RUN_SERIAL ON) # it holds times to bounds
  endif()
endforeach()

# The installed library, as somebody else's project builds with it.
add_test(NAME consumer.buildsAShaderFromTheInstalledLibrary
         COMMAND ${CMAKE_COMMAND} -D BUILD=${CMAKE_BINARY_DIR} -D CONSUMER=${CMAKE_SOURCE_DIR}/tests/consumer
                 -D SCRATCH=${CMAKE_BINARY_DIR}/consumer -D VERSION=${PROJECT_VERSION}
                 -P ${CMAKE_SOURCE_DIR}/tests/consumer/check.cmake)
set_tests_properties(consumer.buildsAShaderFromTheInstalledLibrary PROPERTIES TIMEOUT 120)

# The Debian package, as somebody installs it.
add_test(NAME consumer.theDebianPackageHoldsAToolThatRuns
         COMMAND ${CMAKE_COMMAND} -D BUILD=${CMAKE_BINARY_DIR} -D CPACK=${CMAKE_CPACK_COMMAND} -D SCRATCH=${CMAKE_BINARY_DIR}/deb
                 -D VERSION=${PROJECT_VERSION} -P ${CMAKE_SOURCE_DIR}/tests/consumer/check_deb.cmake)
set_tests_properties(consumer.theDebianPackageHoldsAToolThatRuns PROPERTIES TIMEOUT 300)

# The tables of cases/library are what their scripts make.
add_test(NAME mutation.theTablesAreMadeByTheirScripts COMMAND ${CMAKE_SOURCE_DIR}/tests/mutation/tables_test.sh ${CMAKE_SOURCE_DIR})
set_tests_properties(mutation.theTablesAreMadeByTheirScripts PROPERTIES TIMEOUT 120 SKIP_RETURN_CODE 77)

# A sample of the bugs that the verb mutate plants in what cases/library asks: a minute or two.
if(TARGET crossray)
  add_test(NAME mutation.theTablesCatchASampleOfPlantedBugs
           COMMAND crossray --shaders ${CMAKE_SOURCE_DIR}/shaders --cases ${CMAKE_SOURCE_DIR}/cases mutate ${CMAKE_SOURCE_DIR}/cases/library
                   --shader crossray/core --shader crossray/refract --shader crossray/hierarchy --shader crossray/debug --shader crossray/shared
                   --shader crossray/probe --shader crossray/project/proxy.glsl --shader crossray/project/screen_ray.glsl
                   --shader crossray/project/linear.glsl --shader crossray/project/depth_patch.glsl --shader crossray/project/hiz.glsl
                   --shader crossray/project/patch_tracer.glsl --shader crossray/project/surface_pyramid.glsl --sample 40 --seed 5 --ask 3 -j 2 --min-score 97)
  set_tests_properties(mutation.theTablesCatchASampleOfPlantedBugs PROPERTIES TIMEOUT 600)
endif()

# The files of docs/scale, as their engines would run them.
if(TARGET crossray)
  add_test(NAME scale.theFilesForEnginesMergeToTheUnshardedRun
           COMMAND python3 ${CMAKE_SOURCE_DIR}/tests/scale/files_test.py $<TARGET_FILE:crossray> ${CMAKE_SOURCE_DIR})
  set_tests_properties(scale.theFilesForEnginesMergeToTheUnshardedRun
                       PROPERTIES TIMEOUT 300 SKIP_RETURN_CODE 77 ENVIRONMENT CROSSRAY_CACHE=${CMAKE_BINARY_DIR}/cli-test-cache)
endif()

# An array of four on a Slurm cluster of two nodes, of which one dies. Skipped, with the reason, where Slurm is not there.
if(TARGET crossray)
  add_test(NAME scale.aSlurmArrayThatLosesANodeMergesToTheUnshardedRun
           COMMAND ${CMAKE_SOURCE_DIR}/tests/scale/slurm_test.sh $<TARGET_FILE:crossray> ${CMAKE_SOURCE_DIR})
  set_tests_properties(scale.aSlurmArrayThatLosesANodeMergesToTheUnshardedRun
                       PROPERTIES TIMEOUT 400 SKIP_RETURN_CODE 77 ENVIRONMENT CROSSRAY_CACHE=${CMAKE_BINARY_DIR}/cli-test-cache)
endif()

# Files and requests of any bytes: libFuzzer targets, built apart by clang. Skipped, with the reason, where that is missing.
add_test(NAME fuzz.build COMMAND ${CMAKE_SOURCE_DIR}/tests/fuzz/smoke.sh build)
set_tests_properties(fuzz.build PROPERTIES FIXTURES_SETUP fuzz_targets TIMEOUT 1500 SKIP_RETURN_CODE 77)
file(GLOB fuzz_targets CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/tests/fuzz/targets tests/fuzz/targets/*_target.cpp)
foreach(file ${fuzz_targets})
  string(REPLACE _target.cpp "" target ${file})
  add_test(NAME fuzz.smoke_${target} COMMAND ${CMAKE_SOURCE_DIR}/tests/fuzz/smoke.sh ${target})
  set_tests_properties(fuzz.smoke_${target} PROPERTIES FIXTURES_REQUIRED fuzz_targets TIMEOUT 300 SKIP_RETURN_CODE 77)
endforeach()
foreach(module base judge)
  add_test(NAME fuzz.sanitized_${module} COMMAND ${CMAKE_SOURCE_DIR}/tests/fuzz/smoke.sh unit ${module})
  set_tests_properties(fuzz.sanitized_${module} PROPERTIES FIXTURES_REQUIRED fuzz_targets TIMEOUT 300 SKIP_RETURN_CODE 77)
endforeach()
