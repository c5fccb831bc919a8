// Shader code in words: what can go wrong in it, and its loops, each with the function that it stands in.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace crossray {

inline const std::filesystem::path kShaders = std::filesystem::path(CROSSRAY_SOURCE_DIR) / "shaders";
// Empty where it cannot be read.
std::string readSource(const std::filesystem::path& file);

// Comments and preprocessor lines left out; the lines of the file are kept.
struct GlslToken {
    std::string text;
    int line = 0;
};
std::vector<GlslToken> lexGlsl(std::string_view text);

// A place in a file of the shader folder.
struct GlslPlace {
    std::string file;     // "core/math.glsl"
    std::string function; // empty outside of functions
    int line = 0;
    std::string code; // "/ choose(isDivisor, b, 1.0)", "sqrt(max(x, 0.0))", "int i = 0; i < limit; ++i"
};

// Each division and remainder but those by a constant other than 0, and each call of a function of GLSL that has no
// answer, or an infinite one, to some finite input.
std::vector<GlslPlace> findHazards(const std::vector<GlslToken>& tokens, const std::string& file);
// Each for, while and do, by what stands in its brackets.
std::vector<GlslPlace> findLoops(const std::vector<GlslToken>& tokens, const std::string& file);

} // namespace crossray
