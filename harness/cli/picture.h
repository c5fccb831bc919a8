// A picture of what a case computes: the scene and the debug modes in their display encodings, side by side: as PNG, or
// for a terminal.
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

// Of linear light, clamped to what a picture can show.
double encodeSrgb(double linear);

// Panels in a grid, three bytes a pixel.
struct Picture {
    int width = 0, height = 0;
    std::vector<unsigned char> rgb;
    std::vector<std::string> names; // of the panels, row by row
    int columns = 1;
};

// Panels in a grid of `columns`, each blown up by the same whole factor to at least `panelWidth` pixels.
Picture composePicture(std::span<const Panel> panels, int columns, int panelWidth);
std::string encodePng(const Picture& picture);
// The file is whole or as it was. Throws InputError.
void writePng(const std::filesystem::path& file, const Picture& picture);

// Runs the case on one backend and draws the scene and its outputs, before them, for a case with a hierarchy, the
// frame: the scene with what the rays found on the pixels that trace. `names` picks panels; empty: all.
// Throws EnvironmentError, ShaderError, InputError.
Picture drawCase(const Case& testCase, const std::string& backend, const Folders& folders,
                 std::span<const std::string> names);

// One debug mode alone, in the shader library's display encoding; None draws the scene. Throws InputError where the
// case does not record it.
Picture drawDebugMode(const Case& testCase, const DebugMode& mode, const std::string& backend, const Folders& folders);

} // namespace crossray
