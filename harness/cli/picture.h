// A picture of what a case computes: the scene and the debug modes in their display encodings, side by side, as PNG.
#pragma once

#include "harness/base/plane.h"
#include "harness/case/case.h"
#include "harness/inspect/debug_mode.h"
#include "harness/run/environment.h"

#include <filesystem>
#include <span>
#include <string>

namespace crossray {

// A plane as eight-bit sRGB or encoded colour, three bytes a pixel. Not-a-number is magenta, infinity yellow.
struct Panel {
    std::string name;
    int width = 0, height = 0;
    std::vector<unsigned char> rgb;
};

// Display encodings of the debug modes (domain of HDRP 2018's debug view): directions d*0.5+0.5, HitDepth fract(0.1 z),
// HitSuccess green, blue or black, counts by their maximum; colours are linear radiance shown as sRGB.
Panel encodePanel(const Plane& plane);

// Panels in a grid of `columns`, each blown up by the same whole factor to at least `panelWidth` pixels.
void writePicture(const std::filesystem::path& file, std::span<const Panel> panels, int columns, int panelWidth);

// Runs the case on one backend and draws the scene and its outputs, before them, for a case with a hierarchy, the
// frame: the scene with what the rays found on the pixels that trace. `names` picks panels; empty: all. Returns the
// panels' names in order. Throws EnvironmentError, ShaderError, InputError.
std::vector<std::string> drawCase(const Case& testCase, const std::string& backend, const Folders& folders,
                                  const std::filesystem::path& file, std::span<const std::string> names);

// One debug mode alone, in the shader library's display encoding; None draws the scene. Throws InputError where the
// case does not record it.
std::vector<std::string> drawDebugMode(const Case& testCase, const DebugMode& mode, const std::string& backend,
                                       const Folders& folders, const std::filesystem::path& file);

} // namespace crossray
