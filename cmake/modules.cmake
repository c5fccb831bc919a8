# The house of harness/, from the ground up: a folder may include what its USES name, and what those use.
crossray_module(base PACKAGES glm::glm)
crossray_module(scene USES base PACKAGES PkgConfig::OpenEXR nlohmann_json::nlohmann_json)
crossray_module(compile USES base
                PACKAGES SPIRV glslang MachineIndependent GenericCodeGen OSDependent OGLCompiler
                         glslang-default-resource-limits SPIRV-Tools-opt SPIRV-Tools spirv-cross-c-shared)
crossray_module(backend USES base)
crossray_module(backend/cpu USES base)
crossray_module(backend/vulkan USES base PACKAGES Vulkan::Vulkan)
crossray_module(backend/gl USES base PACKAGES glad ${CMAKE_DL_LIBS})
crossray_module(judge USES base)
crossray_module(case USES scene judge PACKAGES tomlplusplus::tomlplusplus)
crossray_module(expect USES case)
crossray_module(pass USES compile backend expect)
crossray_module(run USES pass backend/cpu backend/vulkan backend/gl
                PACKAGES nlohmann_json::nlohmann_json pugixml::pugixml)
target_compile_definitions(crossray_run PRIVATE CROSSRAY_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                           CROSSRAY_VERSION="${PROJECT_VERSION}")
# Which sources a verdict comes from: shards of one run must agree on it.
file(GLOB_RECURSE verdict_sources CONFIGURE_DEPENDS harness/base/* harness/scene/* harness/compile/* harness/backend/* harness/judge/*
     harness/case/* harness/expect/* harness/pass/* harness/run/* shaders/*)
add_custom_command(
  OUTPUT ${CMAKE_BINARY_DIR}/source_hash.cpp
  COMMAND ${CMAKE_COMMAND} -D OUTPUT=${CMAKE_BINARY_DIR}/source_hash.cpp -D SOURCE=${CMAKE_SOURCE_DIR}
          -P ${CMAKE_SOURCE_DIR}/cmake/source_hash.cmake
  DEPENDS ${verdict_sources} ${CMAKE_SOURCE_DIR}/cmake/source_hash.cmake
  VERBATIM)
target_sources(crossray_run PRIVATE ${CMAKE_BINARY_DIR}/source_hash.cpp)
set_source_files_properties(${CMAKE_BINARY_DIR}/source_hash.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON) # new with each change
crossray_module(bench USES run)
crossray_module(inspect USES run PACKAGES nlohmann_json::nlohmann_json)
# The pages of the report stand in harness/report/web and are strings in the program.
file(GLOB web_files CONFIGURE_DEPENDS harness/report/web/*.html harness/report/web/*.css harness/report/web/*.js)
set(web_source ${CMAKE_BINARY_DIR}/web_files.cpp)
add_custom_command(
  OUTPUT ${web_source}
  COMMAND ${CMAKE_COMMAND} -D OUTPUT=${web_source} -D FOLDER=${CMAKE_SOURCE_DIR}/harness/report/web
          -D FOLDER_NAME=harness/report/web -P ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
  DEPENDS ${web_files} ${CMAKE_SOURCE_DIR}/cmake/embed.cmake
  VERBATIM)
# The atlas of where methods fail is a page of them: the document, and the pictures that it shows.
file(GLOB atlas_files CONFIGURE_DEPENDS docs/stability.md docs/images/stability/* reports/published/*.svg
     reports/published/sweeps/*.svg reports/published/sweeps/README.md)
set(atlas_source ${CMAKE_BINARY_DIR}/atlas_files.cpp)
add_custom_command(
  OUTPUT ${atlas_source}
  COMMAND ${CMAKE_COMMAND} -D OUTPUT=${atlas_source} -D SOURCE=${CMAKE_SOURCE_DIR}
          -P ${CMAKE_SOURCE_DIR}/cmake/embed_atlas.cmake
  DEPENDS ${atlas_files} ${CMAKE_SOURCE_DIR}/cmake/embed_atlas.cmake
  VERBATIM)
crossray_module(report USES run PACKAGES nlohmann_json::nlohmann_json ZLIB::ZLIB)
target_sources(crossray_report PRIVATE ${web_source} ${atlas_source})
set_source_files_properties(${web_source} ${atlas_source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
crossray_module(sweep USES inspect)
crossray_module(inspector USES inspect report PACKAGES PkgConfig::httplib)
crossray_module(mutate USES run PACKAGES nlohmann_json::nlohmann_json)
crossray_module(cli USES bench inspect inspector report sweep mutate PACKAGES CLI11::CLI11 PNG::PNG)
# Files that are compiled alone: GLM is another namespace there (backend/cpu/glsl_glm.h); families have the same functions;
# another type of JSON; classes with members of the file's own types.
file(GLOB bench_families CONFIGURE_DEPENDS harness/bench/family_*.cpp)
set_source_files_properties(harness/pass/hdrp_key.cpp ${bench_families} harness/bench/tracer_yardstick.cpp
                            harness/inspector/question.cpp harness/compile/compile.cpp harness/run/worker_pool.cpp
                            PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
# CLI11 is a header of templates that the optimiser spends minutes on, for a command line that is parsed once.
set_source_files_properties(harness/cli/command_line.cpp harness/cli/command_line_bench.cpp
                            harness/cli/command_line_mutate.cpp PROPERTIES COMPILE_OPTIONS "-O0"
                            SKIP_PRECOMPILE_HEADERS ON)

# The GLSL library as C++ is what a bench times.
file(GLOB shader_units CONFIGURE_DEPENDS harness/backend/cpu/kernels*.cpp harness/bench/*32.cpp harness/inspect/*32.cpp)
set_source_files_properties(${shader_units} PROPERTIES COMPILE_OPTIONS -O3 SKIP_PRECOMPILE_HEADERS ON)
# The GLSL library in float: 0.5 is a float there, as in GLSL.
file(GLOB float_shader_units CONFIGURE_DEPENDS harness/backend/cpu/*32.cpp harness/bench/*32.cpp harness/inspect/*32.cpp)
set_property(SOURCE ${float_shader_units} APPEND PROPERTY COMPILE_OPTIONS -fsingle-precision-constant)
