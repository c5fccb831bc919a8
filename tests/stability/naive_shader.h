// A naive form of a shader's function, and the shader tree that has it in the place of the library's.
//
// A file of tests/stability/naive/ opens with a comment: a line "// Replaces: FILE FUNCTION" for each function (FILE
// below shaders/), and "// Fails: SENTENCE", which may go on over the next lines; where
// drivers part, a line "// On: BACKEND" before that names one that shows it, instead of lavapipe. Then the functions
// stand, each with the signature that it has in the library; what stands before one (a helper, a constant) goes with
// it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace crossray {

struct ReplacedFunction {
    std::string file;     // "crossray/project/hiz.glsl"
    std::string function; // "traceHiz"
};

struct NaiveShader {
    std::filesystem::path path;
    std::string number; // of the situation, "07"
    std::vector<ReplacedFunction> replaces;
    std::string fails;
    std::string text;
    std::string backend = "lavapipe"; // that the cases run on
};

// Throws InputError: no readable file, a name without its number, a head that lacks one of the two.
NaiveShader readNaiveShader(const std::filesystem::path& path);

// Where a function stands in GLSL text: from the end of what comes before it (a comment above it is not its own) to
// past its closing brace.
struct FunctionPlace {
    std::string signature; // "float intersectBoxExit(vec3,vec3,vec3)"
    size_t begin = 0, end = 0;
};

// The definitions at file scope, in order; declarations and structs are none.
std::vector<FunctionPlace> findFunctions(const std::string& text);

// Copies the shader tree to `target` with the naive form's functions in the place of the library's. Throws InputError
// when a function is not found exactly once on both sides.
void writeNaiveTree(const std::filesystem::path& shaders, const NaiveShader& naive,
                    const std::filesystem::path& target);

} // namespace crossray
