// What a case says about reflection probes and the sky: [[probe]], [sky] and the environments that both show.
#pragma once

#include "harness/base/error.h"
#include "harness/scene/scene.h"

#include <glm/glm.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

namespace crossray {

// The values are those of shaders/crossray/probe/shapes.glsl.
enum class VolumeShape { kInfinite = 1, kBox = 2, kSphere = 3 };

enum class ProbeKind { kReflection = 0, kPlanar = 1 };

// Which pipeline's rules weigh and read the probes: HDRP's; the Built-in pipeline's; URP's as its manual has them, and
// as its code has them. The values are those of kProbeProfile.
enum class ProbeProfile { kHdrp = 0, kBuiltIn = 1, kUrpDoc = 2, kUrpUnity = 3 };

// How box projection finds the face ahead: by dividing by both of an axis, or by choosing it first.
// The values are those of shaders/pass/probe_profiles.glsl.
enum class BoxProjectionForm { kDivision = 0, kSelect = 1 };

// Settings of the profiles other than HDRP's.
struct ProfileSettings {
    bool blending = true;       // false: the object's first probe alone, at full weight
    bool boxProjection = true;  // of the probes that enable it
    bool forwardPlus = false;   // urp_unity: no limit of two probes
    bool halfPrecision = false; // urp_unity: as on mobiles
    bool exactMip = false;      // what the parabola 1.7r - 0.7r^2 stands for
    bool gammaSpace = false;    // how RGBM texels are decoded
    BoxProjectionForm boxProjectionForm = BoxProjectionForm::kDivision;
};

// The environment's colours are the RGB of texels that all have this alpha.
struct RgbmDecoding {
    double alpha = 1.0;
    double range = 1.0;       // x of the probe's decode constants
    double exponent = 1.0;    // y
    double alphaWeight = 1.0; // w: how much alpha counts
};

// How the middle of a rough reflection's lobe is found: not at all; with the cosine N.V as it is; with its square, as
// HDRP's code has it.
enum class DominantDirection { kOff = 0, kPlain = 1, kSquared = 2 };

// What an environment's cubemap holds. Every level of the chain below the first is the mean of the finer one's texels,
// but for LevelColors.
struct SolidColor {
    glm::dvec3 color{0.0};
};
struct FaceColors {
    std::array<glm::dvec3, 6> colors{}; // +x -x +y -y +z -z
};
struct LevelColors {
    std::vector<glm::dvec3> colors; // one a level, from the finest; the last goes on
};
struct GradientColors {
    Sky sky; // about the scene's up
};
struct CubemapFile {
    std::filesystem::path file; // a person's own; resolved
};
// What the scene looks like from the probe's capture position; harness/expect/captures.h makes it.
struct SceneCapture {
    enum class Mode { kBaked = 0, kRealtime = 1 } mode = Mode::kRealtime;
    std::optional<int> bounces;      // harness/scene/capture.h
    std::optional<int> face;         // that one alone
    std::filesystem::path bakedFile; // where `crossray bake` puts it; resolved
    SourcePosition position;         // of the key, for what is said when it is not there
};
using EnvironmentContent = std::variant<SolidColor, FaceColors, LevelColors, GradientColors, CubemapFile, SceneCapture>;

struct Environment {
    EnvironmentContent content;
    int size = 16; // texels a side of the finest level; the chain ends at one texel. A CubemapFile has its own
};

// Rotated, not scaled. A box has half extents; a sphere's radius is in x.
struct ProbeVolume {
    VolumeShape shape = VolumeShape::kInfinite;
    glm::dvec3 center{0.0};
    glm::dmat3 worldFromVolume{1.0};
    glm::dvec3 halfExtents{0.0}; // metres
};

struct FaceDistances { // metres inwards from the faces; a sphere's is positive.x
    glm::dvec3 positive{0.0};
    glm::dvec3 negative{0.0};
};

// The plane of a planar probe, and the image in which its mirrored camera captures.
struct ProbeMirror {
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};  // unit
    std::optional<double> fovYDegrees; // nothing: the camera's own
    int width = 0, height = 0;         // pixels
    bool linearFilter = true;          // between the four nearest pixels; else the nearest
};

struct Probe {
    ProbeKind kind = ProbeKind::kReflection;
    ProbeVolume influence; // box or sphere
    FaceDistances blend;
    FaceDistances blendNormal;
    glm::dvec3 facePositive{1.0}; // [0,1]: how far the box's faces let reflections through
    glm::dvec3 faceNegative{1.0};
    ProbeVolume proxy; // of the influence's shape, or infinite
    double minProjectionDistance = 0.0;
    glm::dvec3 capturePosition{0.0};
    double weight = 1.0;
    double multiplier = 1.0;
    int importance = 1;
    bool distanceBasedRoughness = true;
    bool boxProjection = false; // profiles other than HDRP's
    std::optional<RgbmDecoding> rgbm;
    Environment environment; // of a reflection probe
    ProbeMirror mirror;      // of a planar one
};

enum class SkyModel { kNone = 0, kGradient = 1, kCubemap = 2 };

// The last tier of a hierarchy.
struct SkySettings {
    SkyModel model = SkyModel::kGradient;
    Sky gradient; // that of the scene unless given
    std::optional<Environment> environment;
};

// Which tiers answer; the bits of kHierarchy in shaders/bindings/variants.glsl. None: the projection's colour alone.
enum HierarchyTier : unsigned { kTierScreen = 1, kTierProbes = 2, kTierSky = 4 };

inline constexpr int kMostProbes = 8;
inline constexpr int kLargestEnvironment = 512; // texels a side

} // namespace crossray
