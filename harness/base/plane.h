// A named image of numbers: a channel group of a G-buffer, an output of a shader, an expectation.
#pragma once

#include <cassert>
#include <cstddef>
#include <string>
#include <vector>

namespace crossray {

// Row 0 is the top, channels are interleaved. Values are doubles so that cpu64 loses nothing; what a float device computed is
// held exactly.
struct Plane {
    std::string name;
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<double> values;

    Plane() = default;
    Plane(std::string name_, int width_, int height_, int channels_, double fill = 0.0)
        : name(std::move(name_)), width(width_), height(height_), channels(channels_),
          values(static_cast<size_t>(width_) * static_cast<size_t>(height_) * static_cast<size_t>(channels_), fill)
    {
    }

    size_t pixelCount() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    size_t index(int x, int y, int channel = 0) const
    {
        assert(x >= 0 && x < width && y >= 0 && y < height && channel >= 0 && channel < channels);
        return (static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x)) *
                   static_cast<size_t>(channels) +
               static_cast<size_t>(channel);
    }
    double& at(int x, int y, int channel = 0) { return values[index(x, y, channel)]; }
    double at(int x, int y, int channel = 0) const { return values[index(x, y, channel)]; }
    bool sameShape(const Plane& other) const
    {
        return width == other.width && height == other.height && channels == other.channels;
    }
};

} // namespace crossray
