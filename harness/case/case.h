// A case: one TOML file, or one of the named sub-cases that its parameter lists expand into. docs/case-format.md
// documents each key; a test holds that document and the schema of this folder against each other.
#pragma once

#include "harness/base/error.h"
#include "harness/base/outputs.h"
#include "harness/case/history.h"
#include "harness/case/probe.h"
#include "harness/judge/judge.h"
#include "harness/scene/gbuffer.h"
#include "harness/scene/truth.h"

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace crossray {

enum class RefractionModel { kNone = 0, kSphere = 1, kBox = 2, kThin = 3 };
enum class ProjectionModel {
    kNone = 0,
    kProxyInfinite = 1,
    kProxyBox = 2,
    kProxySphere = 3,
    kHiz = 4,
    kLinear = 5,
    kPatches = 6,
    kProxyProbe = 7,
    kOwn = 8 // a person's own tracer
};
// The text's linear ramp, Unity 2018's smoothed ramp, today's smoothed ramp of half the width (domain, section 2).
enum class ScreenWeightForm { kLinear = 0, kSmooth2018 = 1, kSmoothToday = 2 };

// What a refracting surface reflects, and so does not let through.
enum class FresnelModel { kNone = 0, kExact = 1, kSchlick = 2 };

// Thickness by the place on screen, in the place of Material::thickness.
struct ThicknessMap {
    std::filesystem::path file; // resolved; empty: the gradient
    double from = 0, to = 0;    // metres at the left or top border, and at the other
    int axis = 0;               // 0 x, 1 y
};

struct Material {
    RefractionModel refractionModel = RefractionModel::kNone;
    double ior = 1.5;
    double thickness = 1.0; // metres
    double thicknessMultiplier = 1.0;
    double roughness = 0.0; // perceptual
    glm::dvec3 transmittanceColor{1.0};
    double absorptionDistance = 1.0; // metres after which white light has that colour
    FresnelModel fresnel = FresnelModel::kNone;
    std::optional<ThicknessMap> thicknessMap{}; // in the place of the thickness
};

struct ProxyVolume {
    glm::dvec3 center{0.0};
    glm::dmat3 worldFromProxy{1.0}; // rotation, no scale
    glm::dvec3 halfExtents{1.0};    // box
    double radius = 1.0;            // sphere
};

struct HizSettings { // Unity 2018's defaults
    int minLevel = 2;
    int maxLevel = 6;
    int maxIterations = 32;
    double depthBias = 1.0; // "depth success bias", the thickness of what the depth buffer shows, metres
};

struct LinearSettings {
    double stride = 4; // pixels between samples, where steps is 0
    int steps = 0;     // samples over the way on screen; 0: by stride
    int maxIterations = 256;
    double depthBias = 1.0; // metres
    int bisections = 0;     // halvings after a crossing
};

struct PatchSettings {
    int maxLevel = 14;
    int maxIterations = 512;
    double caution = 0.4;    // clearance that a hidden ray needs to have passed behind
    double depthError = 0.0; // affine depth by which the buffer may be wrong
};

struct OwnSettings {                // of a person's own tracer (docs/own-tracer.md)
    std::filesystem::path tracer{}; // resolved
    int maxIterations = 2048;       // handed on to it
};

struct Projection {
    ProjectionModel model = ProjectionModel::kNone; // none: only the ray is computed
    ProxyVolume proxy;
    HizSettings hiz;
    LinearSettings linear;
    PatchSettings patches;
    OwnSettings own;
    double screenWeightDistance = 0.1; // NDC in [0,1]
    ScreenWeightForm screenWeightForm = ScreenWeightForm::kSmooth2018;
};

// A G-buffer of another renderer.
struct RecordedGBuffer {
    std::filesystem::path file;       // resolved
    std::filesystem::path cameraFile; // resolved
    std::filesystem::path truthFile;  // resolved; empty when there is none
    ChannelMap channels;              // blenderChannelMap() unless given
    int tracedObject = 0;             // object index of the pixels that trace
};

// Broken texels of an analytic scene's G-buffer: [scene] poison.
enum class TexelPoison {
    kNone = 0,
    kNan = 1,
    kInfinity = 2,
    kMinusInfinity = 3,
    kNegative = 4,
    kZero = 5,
    kHuge = 6 // near the largest float
};
enum class PoisonedChannel { kBoth = 0, kDepth = 1, kNormal = 2 };

struct GBufferPoison {
    TexelPoison texel = TexelPoison::kNone; // what a broken texel holds, a normal in each component
    PoisonedChannel channel = PoisonedChannel::kBoth;
    int every = 8; // pixels: both of a broken pixel's coordinates are half of it more than a multiple of it

    bool operator==(const GBufferPoison&) const = default;
};

// Exactly one source.
struct AnalyticSource {
    std::string function;
}; // a closed form of harness/expect/, by name
struct TruthSource {
    std::string quantity;
}; // "ray_direction", "hit_depth", "hit", ...
struct ConstantSource {
    std::vector<double> value;
}; // every compared pixel
struct GoldenSource {
    std::filesystem::path file;
}; // resolved; inside the case's folder
struct AgreeSource {
    std::vector<std::string> backends;
}; // each against the last of the list
struct BoundSource {
    std::optional<double> atMost;
}; // every value is a number, and none exceeds the bound where there is one
using ExpectationSource =
    std::variant<AnalyticSource, TruthSource, ConstantSource, GoldenSource, AgreeSource, BoundSource>;

// Which pixels an expectation speaks of.
enum class Where {
    kTraced,         // pixels that trace a ray (default)
    kAll,            // every pixel
    kAnswerable,     // the screen could have known (ScreenKnowledge::kVisible)
    kAnswerableHits, // and the output HitSuccess says hit
    kHits,           // HitSuccess says hit
};

struct Expectation {
    OutputInfo output;
    ExpectationSource source;
    Tolerance tolerance;
    std::optional<HitBudget> budget; // HitSuccess against the truth
    // Share of the compared pixels that may be beyond the tolerance where an ulp of input becomes more than
    // `undecidableAbove` ulps of the output (harness/run/conditioning.h).
    std::optional<double> undecidable;
    double undecidableAbove = kUndecidableAbove;
    Where where = Where::kTraced;
    std::vector<std::string> backends; // empty: all; else only these are held to it
    SourcePosition position;           // of the [[expect]] table
};

struct KnownFailure {
    std::vector<std::string> backends; // empty: all
    std::string issue;                 // a link or number
    std::string until;                 // YYYY-MM-DD, inclusive; after it the failure counts
    std::string reason;
};

struct Case {
    std::string name; // "refraction/sphere_true_sphere", sub-cases "name[ior=1.2,thickness=0.5]"
    std::string summary;
    std::vector<std::string> tags;
    std::filesystem::path file;
    SourcePosition position;

    Camera camera;
    Scene scene; // empty when a recorded G-buffer is given
    std::optional<RecordedGBuffer> recorded;
    TraceEffect effect = TraceEffect::kReflection;
    ScreenLayer screenLayer = ScreenLayer::kAll; // of an analytic scene
    GBufferPoison poison;                        // likewise
    Material material;
    Projection projection;
    std::optional<History> history; // without it colour is read from this frame
    std::vector<Probe> probes;
    ProbeProfile probeProfile = ProbeProfile::kHdrp;
    ProfileSettings profile; // all defaults with HDRP's
    DominantDirection dominantDirection = DominantDirection::kSquared;
    SkySettings sky;
    unsigned hierarchy = 0;          // of HierarchyTier; 0: the projection's colour alone
    std::vector<OutputInfo> outputs; // all that is written: the expected ones and those of `outputs`
    std::vector<Expectation> expectations;
    std::vector<std::string> backends; // empty: all
    std::vector<KnownFailure> knownFailures;
    bool mustFail = false; // passes when the judge fails it on every backend: proof of the ruler
    double timeoutSeconds = 20;
    std::string benchFamily; // methods that `crossray bench` measures; empty: those that go with the effect
    std::string needs;       // kind of method that its scene needs to keep `budget`, for the bench; empty: no claim
    std::string budget;      // "HitDepth<=0.01"
};

// Reads one file and expands its parameter lists. Throws InputError with file:line:column and what is allowed.
std::vector<Case> readCaseFile(const std::filesystem::path& file);

// What a case was read from and refers to: its file, the presets above it, and every file that it names, there or not
// (a golden, a bake). Its answers depend on no others but shaders.
std::vector<std::filesystem::path> listFiles(const Case& testCase);

// Values for one key by its dotted name ("material.ior"), as `--set` and the inspector use. Throws InputError on an
// unknown key or a value out of range.
std::vector<Case> readCaseFile(const std::filesystem::path& file, const std::map<std::string, std::string>& overrides);

// Every *.toml below `root` in order of path, presets.toml and sweeps.toml left out; `root` itself when it is a file.
std::vector<std::filesystem::path> findCaseFiles(const std::filesystem::path& root);
// One key of the format; the schema is the parser's own table.
struct CaseKey {
    std::string table; // "" for the top level, "scene", "expect", ...
    std::string key;
    std::string type;        // "string", "number", "integer", "boolean", "vec3", "list of string", ...
    std::string allowed;     // range or choices, in words
    std::string defaultText; // "required" where there is none
    std::string summary;
};
std::vector<CaseKey> caseSchema();

} // namespace crossray
