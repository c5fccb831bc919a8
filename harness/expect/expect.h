// Makes the expected plane of an expectation, from exactly one source, sharing no code with the shaders: closed forms written in
// doubles from the formulas (analytic_*.cpp, each with its source beside it), the truth tracer, a constant, or a golden file.
#pragma once

#include "harness/case/case.h"
#include "harness/judge/judge.h"
#include "harness/scene/gbuffer.h"
#include "harness/scene/truth.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// What the expectations of one case are computed from; made once a case and shared by all backends. The truth is made on the
// first call that needs it.
class CaseData {
  public:
    explicit CaseData(const Case& testCase); // throws InputError: recorded files that cannot be read
    const Case& testCase() const { return testCase_; }
    const GBuffer& gbuffer() const { return gbuffer_; }
    const Truth& truth() const; // throws InputError when the case has no truth
    const std::vector<bool>& tracedPixels() const { return traced_; }
    std::vector<HitTruth> hitTruth() const;

  private:
    Case testCase_;
    GBuffer gbuffer_;
    std::vector<bool> traced_;
    mutable std::optional<Truth> truth_;
};

// The G-buffer channels that a case's passes read, and those its expectations need.
std::vector<GBufferChannel> channelsFor(const Case& testCase);

// The expected plane of an analytic, truth, constant or golden source. Agreement has no plane of its own: the runner supplies the
// reference backend's. A missing golden returns nothing.
std::optional<Plane> makeExpected(const CaseData& data, const Expectation& expectation);
Mask makeMask(const CaseData& data, const Expectation& expectation, const Plane* hitSuccess);

// The closed forms by name, with the outputs each can answer for: the schema check and the documents list them.
struct ClosedForm {
    std::string name;
    std::vector<std::string> outputs;
    std::string summary;
};
std::span<const ClosedForm> closedForms();
std::span<const ClosedForm> truthQuantities();

} // namespace crossray
