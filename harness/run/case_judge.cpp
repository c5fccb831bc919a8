#include "harness/run/case_judge.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace crossray {

namespace {

const Plane* findPlane(std::span<const Plane> planes, std::string_view name)
{
    const auto found =
        std::find_if(planes.begin(), planes.end(), [&](const Plane& plane) { return plane.name == name; });
    return found == planes.end() ? nullptr : &*found;
}

const Plane& requirePlane(std::span<const Plane> planes, const Expectation& expectation)
{
    if (const Plane* plane = findPlane(planes, expectation.output.name)) return *plane;
    throw InputError(
        expectation.position,
        fmt::format("the output \"{}\" is expected, and no pass of the case writes it", expectation.output.name));
}

bool speaksOf(const Expectation& expectation, const std::string& backend)
{
    if (expectation.backends.empty()) return true;
    return std::find(expectation.backends.begin(), expectation.backends.end(), backend) != expectation.backends.end();
}

// Neither the reference itself nor a backend outside the list is held to an agreement.
bool isHeldTo(const Expectation& expectation, const std::string& backend)
{
    const auto* agree = std::get_if<AgreeSource>(&expectation.source);
    if (agree == nullptr || !speaksOf(expectation, backend) || backend == referenceOf(*agree)) return false;
    return std::find(agree->backends.begin(), agree->backends.end(), backend) != agree->backends.end();
}

} // namespace

const std::string& referenceOf(const AgreeSource& source)
{
    return source.backends.back();
}

bool isAgreement(const Expectation& expectation)
{
    return std::holds_alternative<AgreeSource>(expectation.source);
}

std::string describeSource(const ExpectationSource& source)
{
    struct Describe {
        std::string operator()(const AnalyticSource& analytic) const { return "analytic " + analytic.function; }
        std::string operator()(const TruthSource& truth) const { return "truth " + truth.quantity; }
        std::string operator()(const ConstantSource&) const { return "constant"; }
        std::string operator()(const GoldenSource& golden) const { return "golden " + golden.file.filename().string(); }
        std::string operator()(const AgreeSource& agree) const { return "agree with " + referenceOf(agree); }
        std::string operator()(const BoundSource& bound) const { return bound.atMost ? "at most" : "finite"; }
    };
    return std::visit(Describe{}, source);
}

namespace {

std::string describeBudget(const HitBudget& budget)
{
    std::vector<std::string> parts;
    if (budget.recall) parts.push_back(fmt::format("recall >= {:g}", *budget.recall));
    if (budget.precision) parts.push_back(fmt::format("precision >= {:g}", *budget.precision));
    if (budget.falseHits) parts.push_back(fmt::format("false <= {:g}", *budget.falseHits));
    return fmt::format("{} within {:g} px", fmt::join(parts, ", "), budget.positionPx);
}

} // namespace

std::string describeTolerance(const Expectation& expectation)
{
    if (expectation.budget) return describeBudget(*expectation.budget);
    if (const auto* bound = std::get_if<BoundSource>(&expectation.source))
        return bound->atMost ? fmt::format("{:g}", *bound->atMost) : "any finite number";
    const Tolerance& tolerance = expectation.tolerance;
    std::vector<std::string> bounds;
    if (tolerance.degrees) bounds.push_back(fmt::format("{:g} degrees", *tolerance.degrees));
    if (tolerance.relative) bounds.push_back(fmt::format("{:g} relative", *tolerance.relative));
    if (tolerance.absolute) bounds.push_back(fmt::format("{:g} absolute", *tolerance.absolute));
    if (tolerance.ulps) {
        bounds.push_back(fmt::format("{:g} ulp{}", *tolerance.ulps, tolerance.doublePrecision ? " of a double" : ""));
    }
    std::string text = bounds.empty() ? "exact" : fmt::format("{}", fmt::join(bounds, " or "));
    if (tolerance.floor > 0) text += fmt::format(", below {:g} zero", tolerance.floor);
    if (tolerance.outlierShare > 0 && tolerance.worst) {
        text += fmt::format("; {:g} % may be off by up to {:g}", tolerance.outlierShare * 100, *tolerance.worst);
    }
    if (expectation.undecidable) {
        text += fmt::format("; {:g} % are excused where an ulp of input becomes more than {:g}",
                            *expectation.undecidable * 100, expectation.undecidableAbove);
    }
    return text;
}

ExpectationResult CaseJudge::startResult(size_t index) const
{
    const Expectation& expectation = data_->testCase().expectations[index];
    ExpectationResult result;
    result.index = index;
    result.output = expectation.output.name;
    result.source = describeSource(expectation.source);
    result.position = expectation.position;
    result.tolerance = describeTolerance(expectation);
    result.undecidable = expectation.undecidable;
    if (expectation.undecidable) result.undecidableAbove = expectation.undecidableAbove;
    return result;
}

std::shared_ptr<const Plane> CaseJudge::expectedPlane(size_t index)
{
    const std::lock_guard lock(mutex_);
    Made& made = expected_[index];
    if (!made.done) {
        if (auto plane = makeExpected(*data_, data_->testCase().expectations[index])) {
            made.plane = std::make_shared<const Plane>(std::move(*plane));
        }
        made.done = true;
    }
    return made.plane;
}

Mask CaseJudge::maskFor(const Expectation& expectation, std::span<const Plane> planes)
{
    const std::lock_guard lock(mutex_);
    return makeMask(*data_, expectation, findPlane(planes, "HitSuccess"));
}

namespace {

// The judge knows planes and tolerances, not where they were written.
template <typename Compare>
Comparison compareAt(const SourcePosition& position, const Compare& comparePlanes)
{
    try {
        return comparePlanes();
    } catch (const InputError& error) {
        if (!error.position().file.empty()) throw;
        throw InputError(position, error.what());
    }
}

void markUndecidable(const Mask& undecidable, Mask& mask)
{
    for (size_t pixel = 0; pixel < undecidable.size(); ++pixel) {
        if (mask[pixel] != 0 && undecidable[pixel] != 0) mask[pixel] = kUndecidablePixel;
    }
}

} // namespace

Comparison CaseJudge::compareWith(const Expectation& expectation, const Plane& expected, std::span<const Plane> planes)
{
    const Plane& actual = requirePlane(planes, expectation);
    Mask mask = maskFor(expectation, planes);
    if (const auto* bound = std::get_if<BoundSource>(&expectation.source))
        return compareAt(expectation.position,
                         [&] { return compareWithBound(expected, actual, mask, !bound->atMost.has_value()); });
    Tolerance tolerance = expectation.tolerance;
    const auto judge = [&] {
        return compareAt(expectation.position,
                         [&] { return compare(expectation.output.type, expected, actual, mask, tolerance); });
    };
    Comparison strict = judge();
    if (!expectation.undecidable || !conditioning_ || (strict.passed && !conditioning_->known())) return strict;
    const Conditioning& conditioning = conditioning_->get();
    if (!conditioning.note.empty()) {
        if (!strict.passed) strict.reason += fmt::format("; nothing is excused: {}", conditioning.note);
        return strict;
    }
    markUndecidable(findUndecidable(conditioning, expectation.output.name, expectation.undecidableAbove), mask);
    tolerance.undecidableShare = *expectation.undecidable;
    return judge();
}

Comparison CaseJudge::compareWithTruth(const Expectation& expectation, std::span<const Plane> planes)
{
    std::shared_ptr<const std::vector<HitTruth>> truth;
    {
        const std::lock_guard lock(mutex_);
        if (!hitTruth_) hitTruth_ = std::make_shared<const std::vector<HitTruth>>(data_->hitTruth());
        truth = hitTruth_;
    }
    return judgeHits(*truth, requirePlane(planes, expectation), findPlane(planes, "HitPositionSS"),
                     *expectation.budget);
}

std::vector<ExpectationResult> CaseJudge::judgeAlone(const std::string& backend, std::span<const Plane> planes)
{
    std::vector<ExpectationResult> results;
    const auto& expectations = data_->testCase().expectations;
    for (size_t index = 0; index < expectations.size(); ++index) {
        const Expectation& expectation = expectations[index];
        if (isAgreement(expectation) || !speaksOf(expectation, backend)) continue;
        ExpectationResult result = startResult(index);
        if (expectation.budget) {
            result.comparison = compareWithTruth(expectation, planes);
            result.judged = true;
        } else if (const auto expected = expectedPlane(index)) {
            result.comparison = compareWith(expectation, *expected, planes);
            result.judged = true;
        } else {
            result.missingGolden = true;
            result.note = "there is no golden file; crossray review --accept records one";
        }
        results.push_back(std::move(result));
    }
    return results;
}

std::vector<ExpectationResult>
CaseJudge::judgeAgreements(const std::string& backend,
                           const std::map<std::string, std::vector<Plane>>& planesOfBackends)
{
    std::vector<ExpectationResult> results;
    const auto own = planesOfBackends.find(backend);
    if (own == planesOfBackends.end()) return results;
    const auto& expectations = data_->testCase().expectations;
    for (size_t index = 0; index < expectations.size(); ++index) {
        const Expectation& expectation = expectations[index];
        if (!isHeldTo(expectation, backend)) continue;
        ExpectationResult result = startResult(index);
        const std::string& reference = referenceOf(std::get<AgreeSource>(expectation.source));
        const auto other = planesOfBackends.find(reference);
        if (other == planesOfBackends.end()) {
            result.note = fmt::format("{} gave no answer to agree with", reference);
        } else {
            result.comparison = compareWith(expectation, requirePlane(other->second, expectation), own->second);
            result.judged = true;
        }
        results.push_back(std::move(result));
    }
    return results;
}

std::vector<std::string> CaseJudge::referencesOf(const std::string& backend) const
{
    std::vector<std::string> references;
    for (const Expectation& expectation : data_->testCase().expectations) {
        if (isHeldTo(expectation, backend))
            references.push_back(referenceOf(std::get<AgreeSource>(expectation.source)));
    }
    return references;
}

bool CaseJudge::isReference(const std::string& backend) const
{
    const auto& expectations = data_->testCase().expectations;
    return std::any_of(expectations.begin(), expectations.end(), [&](const Expectation& expectation) {
        const auto* agree = std::get_if<AgreeSource>(&expectation.source);
        return agree != nullptr && referenceOf(*agree) == backend;
    });
}

namespace {

constexpr double kCompared = 1, kComparedWhereHit = 2;

// What the mask is before a backend's own hits narrow it.
Plane makeMaskPlane(const CaseData& data, Expectation expectation)
{
    const bool asksForHits = expectation.where == Where::kHits || expectation.where == Where::kAnswerableHits;
    if (expectation.where == Where::kHits) expectation.where = Where::kTraced;
    if (expectation.where == Where::kAnswerableHits) expectation.where = Where::kAnswerable;
    const Mask mask = makeMask(data, expectation, nullptr);
    const Camera& camera = data.testCase().camera;
    Plane plane({}, camera.width, camera.height, 1);
    for (size_t pixel = 0; pixel < mask.size(); ++pixel)
        plane.values[pixel] = mask[pixel] == 0 ? 0.0 : asksForHits ? kComparedWhereHit : kCompared;
    return plane;
}

// What a budget counts as right: a hit where the screen could have known it, else unknown.
Plane makeClassPlane(const std::vector<HitTruth>& truth, const Camera& camera)
{
    Plane plane({}, camera.width, camera.height, 1);
    for (size_t pixel = 0; pixel < truth.size(); ++pixel) {
        const HitClass hitClass = !truth[pixel].traced      ? HitClass::kNoRaycast
                                  : truth[pixel].answerable ? HitClass::kHit
                                                            : HitClass::kUnknown;
        plane.values[pixel] = static_cast<double>(hitClass);
    }
    return plane;
}

} // namespace

std::vector<Plane> CaseJudge::takeExpectedPlanes() const
{
    const std::lock_guard lock(mutex_);
    std::vector<Plane> planes;
    for (const auto& [index, made] : expected_) {
        if (!made.plane) continue;
        planes.push_back(*made.plane);
        planes.back().name = fmt::format("{}@{}", data_->testCase().expectations[index].output.name, index);
    }
    const auto& expectations = data_->testCase().expectations;
    for (size_t index = 0; hitTruth_ && index < expectations.size(); ++index) {
        if (!expectations[index].budget) continue;
        planes.push_back(makeClassPlane(*hitTruth_, data_->testCase().camera));
        planes.back().name = fmt::format("{}@{}", expectations[index].output.name, index);
    }
    return planes;
}

std::vector<Plane> CaseJudge::makeMaskPlanes() const
{
    const std::lock_guard lock(mutex_);
    std::vector<Plane> planes;
    const auto& expectations = data_->testCase().expectations;
    for (size_t index = 0; index < expectations.size(); ++index) {
        if (expectations[index].budget) continue; // judged against the truth, ray by ray
        Plane plane = makeMaskPlane(*data_, expectations[index]);
        if (std::all_of(plane.values.begin(), plane.values.end(), [](double value) { return value == kCompared; }))
            continue;
        const auto same = std::find_if(planes.begin(), planes.end(),
                                       [&](const Plane& other) { return other.values == plane.values; });
        if (same != planes.end()) {
            same->name += fmt::format(",{}", index);
        } else {
            plane.name = fmt::format("mask@{}", index);
            planes.push_back(std::move(plane));
        }
    }
    return planes;
}

} // namespace crossray
