// Makes the expected plane of an expectation, from exactly one source, sharing no code with the shaders: closed forms
// written in doubles from the formulas (analytic_*.cpp, each with its source beside it), the truth tracer, a constant,
// or a golden file.
#pragma once

#include "harness/case/case.h"
#include "harness/expect/frame_history.h"
#include "harness/judge/judge.h"
#include "harness/scene/cubemap.h"
#include "harness/scene/gbuffer.h"
#include "harness/scene/truth.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace crossray {

// What a pixel's ray starts from, in exact numbers.
struct SurfacePoint {
    glm::dvec3 positionWS{0.0};
    glm::dvec3 normalWS{0.0}; // unit, on the viewer's side
    glm::dvec3 toEyeWS{0.0};  // unit
    int primitive = -1;       // of the scene; -1 in recorded data
    // Metres, with the multiplier, where the case has a thickness map; else the material's.
    std::optional<double> thickness{};
};

// What the expectations of one case are computed from; made once a case and shared by all backends. Surfaces,
// environments and truth are made on the first call that needs them; all members may be called from several threads.
class CaseData {
  public:
    // Throws InputError: an invalid camera or scene, recorded files that cannot be read.
    explicit CaseData(const Case& testCase);
    // The same, with what `earlier` has made and this case would make alike: G-buffer, surfaces and truth hang on scene
    // and camera alone, and not on the material or the projection.
    CaseData(const Case& testCase, const CaseData& earlier);
    ~CaseData();
    CaseData(CaseData&&) noexcept;
    CaseData& operator=(CaseData&&) noexcept;

    const Case& testCase() const { return testCase_; }
    const GBuffer& gbuffer() const { return *gbuffer_; }
    // What rays are traced in: the G-buffer, or that of what is opaque (depth, normal, and colour where it has one).
    const GBuffer& screen() const { return opaque_ ? *opaque_ : *gbuffer_; }

    // Pixels that trace a ray: those whose nearest surface is a mirror (reflection) or glass (refraction), in recorded
    // data those of the traced object (any surface when it is 0).
    const std::vector<bool>& tracedPixels() const { return traced_; }

    // Of every traced pixel, at its centre: from the scene's geometry, not from the G-buffer, which rounds; from the
    // G-buffer when it was recorded, because it is all there is. The other pixels hold zeros.
    const std::vector<SurfacePoint>& surfaces() const;

    // What the case's probes show, in its order, and after them the sky's cubemap where the sky is one.
    const std::vector<Cubemap>& environments() const;

    const Truth& truth() const; // throws InputError when the case has no truth

    // Of a case with a [history]; else null.
    const FrameHistory* history() const { return history_ ? &*history_ : nullptr; }
    const std::vector<Plane>& colorLevels() const; // of the history's colour; on the first call that needs them
    // Of a case with a thickness map; else null.
    const Plane* thicknessMap() const { return thicknessMap_ ? &*thicknessMap_ : nullptr; }

    // A traced pixel whose ray does not exist (total internal reflection) is unanswerable.
    std::vector<HitTruth> hitTruth() const;

  private:
    struct Lazy;
    CaseData(const Case& testCase, const CaseData* earlier);

    Case testCase_;
    std::shared_ptr<const GBuffer> gbuffer_; // shared with the data of a case that shows the same
    std::shared_ptr<const GBuffer> opaque_;  // null: the same as the G-buffer
    std::vector<bool> traced_;
    std::optional<FrameHistory> history_;
    std::optional<Plane> thicknessMap_;
    std::unique_ptr<Lazy> lazy_;
};

// The G-buffer channels that a case's passes read, and those its expectations need.
std::vector<GBufferChannel> channelsFor(const Case& testCase);

// The expected plane of an analytic, truth, constant or golden source; 0 at pixels that trace no ray (a constant is
// everywhere, and so is a bound, which for "finite" is the largest float). Agreement has no plane of its own: the
// runner supplies the reference backend's. A missing golden returns nothing. Throws InputError at the expectation's
// position, with what is allowed: an unknown name, an output that the source cannot answer for, a closed form or a
// truth that the case's data cannot give, a golden of another shape.
std::optional<Plane> makeExpected(const CaseData& data, const Expectation& expectation);

// What of makeExpected()'s errors can be known before anything is computed: names of closed forms and truths, outputs
// that they cannot answer for, cases that they do not fit. Throws InputError.
void checkSources(const Case& testCase);

// The pixels that the expectation speaks of, less those for which its source has no answer: where the truth has no ray
// there is no direction, origin or path. `hitSuccess` is the backend's own output, for Where::kHits and
// kAnswerableHits: throws InputError when it is needed and missing.
Mask makeMask(const CaseData& data, const Expectation& expectation, const Plane* hitSuccess);

// The closed forms by name, with the outputs each can answer for: the schema check and the documents list them.
//
// Inputs are the exact surface points and the case's material, proxy and screen-weight settings. At degenerate inputs
// they give the documented answers of the library:
//   refraction   N.V below 1e-4: the normal is tilted in the plane of N and V until N.V = 1e-4. Index of refraction
//   taken into
//                [0.001, 1000], thickness into [0, 65504]. Total reflection at the entry: no raycast, the direction is
//                the reflected one, the origin the surface point, the path 0. Thickness 0: the sphere gives its limit
//                (the direction does not depend on the thickness), the box -V; both at the entry point. A box's path is
//                at most 100 thicknesses. A sphere's exit never reflects totally: inside, both ends of a chord meet the
//                surface at the same angle.
//   reflection   N.V of 0 and below: straight on. A normal of length 0 (recorded data): no ray, the zero vector.
//   proxies      seen from inside: the far face or root. A ray that does not meet the proxy, or whose hit is not in
//   front of
//                the camera, is a miss; depth and screen position are 0 then.
//   screen weight  distance 0: 1 on the screen, borders included; 0 off it.
struct ClosedForm {
    std::string name;
    std::vector<std::string> outputs;
    std::string summary;
};
std::span<const ClosedForm> closedForms();
std::span<const ClosedForm> truthQuantities();

} // namespace crossray
