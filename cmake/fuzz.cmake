# libFuzzer targets (preset fuzz): what reads files and requests, on any bytes. Clang alone; the modules below run, so that
# they build in two minutes.
if(NOT CMAKE_CXX_COMPILER_ID MATCHES Clang)
  message(FATAL_ERROR "CROSSRAY_FUZZ needs clang (Debian: clang libclang-rt-14-dev): cmake --preset fuzz")
endif()

add_custom_target(fuzz_targets)
function(crossray_fuzz_target name)
  cmake_parse_arguments(arg "" "" "SOURCES;USES" ${ARGN})
  add_executable(fuzz_${name} tests/fuzz/targets/${name}_target.cpp ${arg_SOURCES})
  crossray_precompile(fuzz_${name} crossray_base)
  crossray_unity_build(fuzz_${name})
  target_link_libraries(fuzz_${name} PRIVATE ${arg_USES})
  target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
  target_compile_definitions(fuzz_${name} PRIVATE CROSSRAY_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  add_dependencies(fuzz_targets fuzz_${name})
endfunction()

crossray_fuzz_target(case USES crossray_case)
crossray_fuzz_target(exr USES crossray_scene)
crossray_fuzz_target(camera USES crossray_scene)
# What reads and merges run.json, without what runs.
file(GLOB run_json_sources CONFIGURE_DEPENDS harness/run/run_json*.cpp harness/run/*_json.cpp harness/run/bare_case.cpp)
list(REMOVE_DUPLICATES run_json_sources)
crossray_fuzz_target(run
  SOURCES ${run_json_sources} harness/run/run_slices.cpp harness/run/results.cpp harness/run/verdict.cpp
          harness/run/merge_inputs.cpp harness/run/run_plan_compare.cpp harness/run/attempt.cpp harness/run/shard.cpp
  USES crossray_case nlohmann_json::nlohmann_json)
crossray_fuzz_target(question
  SOURCES harness/inspector/question.cpp harness/inspector/controls.cpp
  USES crossray_case nlohmann_json::nlohmann_json)
crossray_fuzz_target(server
  SOURCES harness/inspector/server.cpp harness/inspector/routes.cpp
  USES crossray_base nlohmann_json::nlohmann_json PkgConfig::httplib)
