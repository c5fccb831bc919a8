#include "harness/cli/show_color.h"
#include "harness/cli/conditioning_text.h"
#include "harness/cli/terminal_picture.h"
#include "harness/cli/verbs.h"
#include "harness/compile/source.h"
#include "harness/expect/planar_diagnosis.h"
#include "harness/run/case_flight.h"
#include "harness/run/case_judge.h"
#include "harness/run/environment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <unistd.h>

#include <algorithm>
#include <optional>

namespace crossray {

namespace {

std::string_view nameOf(PrimitiveShape shape)
{
    switch (shape) {
    case PrimitiveShape::kPlane:
        return "plane";
    case PrimitiveShape::kSphere:
        return "sphere";
    case PrimitiveShape::kBox:
        return "box";
    case PrimitiveShape::kLens:
        return "lens";
    case PrimitiveShape::kTorus:
        return "torus";
    }
    return "";
}

std::string_view nameOf(RefractionModel model)
{
    switch (model) {
    case RefractionModel::kNone:
        return "none";
    case RefractionModel::kSphere:
        return "sphere";
    case RefractionModel::kBox:
        return "box";
    case RefractionModel::kThin:
        return "thin";
    }
    return "";
}

std::string_view nameOf(Where where)
{
    switch (where) {
    case Where::kTraced:
        return "traced pixels";
    case Where::kAll:
        return "all pixels";
    case Where::kAnswerable:
        return "answerable pixels";
    case Where::kAnswerableHits:
        return "answerable pixels that hit";
    case Where::kHits:
        return "pixels that hit";
    }
    return "";
}

std::string formatVector(const glm::dvec3& v)
{
    return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z);
}

std::string formatCamera(const Camera& camera)
{
    const bool isPerspective = camera.projection == ProjectionKind::kPerspective;
    const std::string_view convention = camera.depthConvention == DepthConvention::kReversed   ? "reversed"
                                        : camera.depthConvention == DepthConvention::kStandard ? "standard"
                                                                                               : "infinite reversed";
    const std::string view = isPerspective ? fmt::format("perspective, {:g} degrees high", camera.fovYDegrees)
                                           : fmt::format("orthographic, {:g} m high", camera.orthographicHeight);
    return fmt::format("{}x{}, {}, eye {}, near {:g} m, far {:g} m, {} depth in {}", camera.width, camera.height, view,
                       formatVector(glm::dvec3(camera.worldFromView[3])), camera.nearDistance, camera.farDistance,
                       convention, camera.ndcDepthRange == NdcDepthRange::kZeroToOne ? "[0,1]" : "[-1,1]");
}

std::string formatSize(const Primitive& primitive)
{
    switch (primitive.shape) {
    case PrimitiveShape::kPlane:
        return "";
    case PrimitiveShape::kSphere:
        return fmt::format(", radius {:g} m", primitive.radius) +
               (primitive.wall > 0.0 ? fmt::format(", wall {:g} m", primitive.wall) : "");
    case PrimitiveShape::kBox:
        return ", half extents " + formatVector(primitive.halfExtents);
    case PrimitiveShape::kLens:
        return fmt::format(", radius {:g} m, thickness {:g} m", primitive.radius, primitive.thickness);
    case PrimitiveShape::kTorus:
        return fmt::format(", radius {:g} m, tube radius {:g} m", primitive.radius, primitive.tubeRadius);
    }
    return "";
}

void printScene(const Case& testCase)
{
    if (testCase.recorded) {
        fmt::print("scene      {} (recorded)\n", testCase.recorded->file.string());
        fmt::print("           camera {}\n", testCase.recorded->cameraFile.string());
        if (!testCase.recorded->truthFile.empty())
            fmt::print("           truth {}\n", testCase.recorded->truthFile.string());
        return;
    }
    const char* label = "scene";
    for (const Primitive& primitive : testCase.scene.primitives) {
        fmt::print("{:<10} {} at {}{}, {}\n", label, nameOf(primitive.shape), formatVector(primitive.center),
                   formatSize(primitive), primitive.material);
        label = "";
    }
    if (testCase.scene.primitives.empty()) fmt::print("scene      nothing but the sky\n");
}

void printProjection(const Projection& projection)
{
    const ProxyVolume& proxy = projection.proxy;
    switch (projection.model) {
    case ProjectionModel::kNone:
        fmt::print("projection none: the ray alone\n");
        return;
    case ProjectionModel::kProxyInfinite:
        fmt::print("projection proxy, infinite");
        break;
    case ProjectionModel::kProxyBox:
        fmt::print("projection proxy, box at {}, half extents {}", formatVector(proxy.center),
                   formatVector(proxy.halfExtents));
        break;
    case ProjectionModel::kProxySphere:
        fmt::print("projection proxy, sphere at {}, radius {:g} m", formatVector(proxy.center), proxy.radius);
        break;
    case ProjectionModel::kProxyProbe:
        fmt::print("projection proxy of the first probe, else infinite");
        break;
    case ProjectionModel::kHiz:
        fmt::print("projection HiZ, levels {} to {}, {} iterations, depth bias {:g} m", projection.hiz.minLevel,
                   projection.hiz.maxLevel, projection.hiz.maxIterations, projection.hiz.depthBias);
        break;
    case ProjectionModel::kLinear: {
        const LinearSettings& linear = projection.linear;
        fmt::print("projection linear, {}, {} iterations, {} bisections, depth bias {:g} m",
                   linear.steps > 0 ? fmt::format("{} steps", linear.steps)
                                    : fmt::format("a step each {:g} px", linear.stride),
                   linear.maxIterations, linear.bisections, linear.depthBias);
        break;
    }
    case ProjectionModel::kOwn:
        fmt::print("projection own, {}, {} iterations, depth bias {:g} m", displayPath(projection.own.tracer),
                   projection.own.maxIterations, projection.hiz.depthBias);
        break;
    case ProjectionModel::kPatches:
        fmt::print("projection patches, levels to {}, {} iterations, caution {:g}", projection.patches.maxLevel,
                   projection.patches.maxIterations, projection.patches.caution);
        break;
    }
    fmt::print(", screen weight over {:g}\n", projection.screenWeightDistance);
}

void printProbes(const Case& testCase)
{
    std::optional<CaseData> data; // the surfaces, for planar probes alone
    const char* label = "probes";
    for (size_t i = 0; i < testCase.probes.size(); ++i) {
        const Probe& probe = testCase.probes[i];
        const bool isPlanar = probe.kind == ProbeKind::kPlanar;
        const bool isSphere = probe.influence.shape == VolumeShape::kSphere;
        fmt::print("{:<10} {}: {}, influence {} at {}, {}\n", label, i + 1, isPlanar ? "planar" : "reflection",
                   isSphere ? "sphere" : "box", formatVector(probe.influence.center),
                   isSphere ? fmt::format("radius {:g} m", probe.influence.halfExtents.x)
                            : "half extents " + formatVector(probe.influence.halfExtents));
        label = "";
        if (!isPlanar) continue;
        fmt::print("{:<10}    mirror at {}, normal {}, capture {}x{}\n", label, formatVector(probe.mirror.position),
                   formatVector(probe.mirror.normal), probe.mirror.width, probe.mirror.height);
        if (!data) data.emplace(testCase);
        for (const std::string& line : describeDiagnosis(diagnosePlanar(*data, probe)))
            fmt::print("{:<10}    {}\n", label, line);
    }
}

void printExpectations(const Case& testCase)
{
    const char* label = "expects";
    for (const Expectation& expectation : testCase.expectations) {
        const std::string on =
            expectation.backends.empty() ? "" : fmt::format(" on {}", fmt::join(expectation.backends, ", "));
        fmt::print("{:<10} {}: {}, {}, {}{}   {}\n", label, expectation.output.name, describeSource(expectation.source),
                   describeTolerance(expectation), nameOf(expectation.where), on, expectation.position.format());
        label = "";
    }
}

void printBackends(const Case& testCase, const std::vector<std::string>& wanted)
{
    const char* label = "backends";
    for (const BackendInfo& info : listBackends()) {
        const bool isAskedFor = wanted.empty() ? info.byDefault
                                               : std::find(wanted.begin(), wanted.end(), info.name) != wanted.end() ||
                                                     std::find(wanted.begin(), wanted.end(), "all") != wanted.end();
        const std::string whyNot = whyNotOn(testCase, info.name);
        std::string what = "runs";
        if (!isAskedFor) what = "not asked for";
        if (!whyNot.empty()) what = "skipped: " + whyNot;
        if (!info.found) what = "not there: " + info.missing;
        fmt::print("{:<10} {:<12} {}\n", label, info.name, what);
        label = "";
    }
    for (const KnownFailure& known : testCase.knownFailures) {
        fmt::print("{:<10} {} until {} on {}: {}\n", "known", known.issue, known.until,
                   known.backends.empty() ? "all" : fmt::format("{}", fmt::join(known.backends, ", ")), known.reason);
    }
}

void printCase(const Case& testCase, const ShowOptions& options, const Style& style)
{
    const bool isWrapped = isTerminal(STDOUT_FILENO);
    fmt::print("{}\n{}\n", style.paint(Ink::kBold, testCase.name),
               isWrapped ? wrap(testCase.summary, terminalWidth(STDOUT_FILENO), 0) : testCase.summary);
    fmt::print("file       {}\n", testCase.position.file.empty() ? testCase.file.string() : testCase.position.format());
    if (!testCase.tags.empty()) fmt::print("tags       {}\n", fmt::join(testCase.tags, ", "));
    printScene(testCase);
    fmt::print("camera     {}\n", formatCamera(testCase.camera));
    const Material& material = testCase.material;
    if (testCase.effect == TraceEffect::kReflection) {
        fmt::print("effect     reflection, roughness {:g}\n", material.roughness);
    } else {
        fmt::print("effect     refraction, {} model, index {:g}, thickness {:g} m x {:g}, roughness {:g}\n",
                   nameOf(material.refractionModel), material.ior, material.thickness, material.thicknessMultiplier,
                   material.roughness);
        printAbsorption(material);
    }
    if (testCase.history) printHistory(*testCase.history, formatCamera(testCase.history->camera));
    printProjection(testCase.projection);
    printProbes(testCase);
    std::vector<std::string_view> outputs;
    for (const OutputInfo& output : testCase.outputs)
        outputs.push_back(output.name);
    fmt::print("outputs    {}\n", fmt::join(outputs, ", "));
    printExpectations(testCase);
    if (testCase.mustFail) fmt::print("must fail  passes when the judge fails each of its expectations\n");
    fmt::print("timeout    {:g} s\n", testCase.timeoutSeconds);
    printBackends(testCase, options.backends);
}

void printConditioning(const Case& testCase, const Folders& folders, const std::string& pixelText)
{
    const Conditioning conditioning = measureConditioning(testCase, folders);
    if (!conditioning.note.empty()) {
        fmt::print("conditioning not measured: {}\n", conditioning.note);
        return;
    }
    if (pixelText.empty()) {
        const CaseData data(testCase);
        fmt::print("{}", formatConditioning(summarize(conditioning, data.tracedPixels())));
        return;
    }
    const glm::ivec2 pixel = parsePixel(pixelText);
    const Camera& camera = testCase.camera;
    checkPixel(camera, pixel);
    const size_t index =
        static_cast<size_t>(pixel.y) * static_cast<size_t>(camera.width) + static_cast<size_t>(pixel.x);
    fmt::print("conditioning of pixel {},{}: ulp for an ulp on cpu64, on cpu32, and cpu32 against cpu64\n", pixel.x,
               pixel.y);
    for (const std::string& line : describePixelConditioning(listAt(conditioning, index)))
        fmt::print("           {}\n", line);
}

} // namespace

int showCase(const GlobalOptions& global, const ShowOptions& options)
{
    const bool isTerminalAlone = options.image == "-";
    if (!options.image.empty() && !isTerminalAlone && !options.image.ends_with(".png")) {
        throw InputError(fmt::format("--image {}: allowed is FILE.png, or - for the terminal alone", options.image));
    }
    if (options.image.empty() && !options.debugMode.empty()) {
        throw InputError("--debug-mode draws a picture: it needs --image FILE.png");
    }
    if (!options.pixel.empty() && !options.conditioning)
        throw InputError("--pixel says of a pixel how it is conditioned: it needs --conditioning");
    const Folders folders = findFolders(global.shaders, global.cases, global.cache);
    const SelectedCases selected = selectCases({{options.testCase}, {}, {}, {}, false}, folders.cases, {}, false);
    if (selected.exitCode) return static_cast<int>(*selected.exitCode);
    if ((!options.image.empty() || options.conditioning) && selected.cases.size() > 1) {
        throw InputError(fmt::format("{} one case; \"{}\" means {}, the first of them \"{}\"",
                                     options.conditioning ? "--conditioning measures" : "--image draws",
                                     options.testCase, selected.cases.size(), selected.cases.front().name));
    }
    const Style style = Style::choose(global.color, STDOUT_FILENO);
    const PictureProtocol protocol = choosePictureProtocol(style.isColored());
    if (isTerminalAlone && protocol == PictureProtocol::kNone) {
        throw InputError("--image -: standard output is no terminal with colours; allowed are --image FILE.png, and "
                         "--color always");
    }
    bool isFirst = true;
    for (const Case& testCase : selected.cases) {
        if (!isFirst) fmt::print("\n");
        isFirst = false;
        printCase(testCase, options, style);
    }
    if (options.conditioning) printConditioning(selected.cases.front(), folders, options.pixel);
    if (options.image.empty()) return static_cast<int>(ExitCode::kAsExpected);

    const std::string backend = options.backends.empty() ? "lavapipe" : options.backends.front();
    const Case& drawn = selected.cases.front();
    const Picture picture = options.debugMode.empty()
                                ? drawCase(drawn, backend, folders, options.panels)
                                : drawDebugMode(drawn, findDebugMode(options.debugMode), backend, folders);
    if (!isTerminalAlone) writePng(options.image, picture);
    fmt::print("image      {}{} ({})\n", isTerminalAlone ? "" : options.image + ": ", fmt::join(picture.names, ", "),
               backend);
    fmt::print("{}", formatPicture(picture, protocol, terminalWidth(STDOUT_FILENO)));
    return static_cast<int>(ExitCode::kAsExpected);
}

} // namespace crossray
