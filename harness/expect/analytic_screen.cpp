// The screen weight (domain, section 2): how much a hit counts near the border of the image.
#include "harness/expect/analytic.h"

#include <algorithm>

namespace crossray {

namespace {

// The cubic with S(0) = 0, S(1) = 1 and flat ends, from its point symmetry about (1/2, 1/2).
double smoothStep(double x)
{
    const double fromMiddle = x - 0.5;
    return 0.5 + fromMiddle * (1.5 - 2.0 * fromMiddle * fromMiddle);
}

// One axis. Linear in the distance to the nearer border: 0 on it, 1 from `width` on.
double rampAt(double coordinate, double width, bool smooth)
{
    if (!(coordinate >= 0.0 && coordinate <= 1.0)) return 0.0;
    if (!(width > 0.0)) return 1.0;
    const double toBorder = coordinate < 0.5 ? coordinate : 1.0 - coordinate;
    if (toBorder >= width) return 1.0;
    const double share = toBorder / width;
    return smooth ? smoothStep(share) : share;
}

} // namespace

double screenWeightAt(const glm::dvec2& uv, double distance, ScreenWeightForm form)
{
    // Today's form measures 1 - |2x - 1|, twice the distance to the border, against the same number.
    const double width = form == ScreenWeightForm::kSmoothToday ? 0.5 * distance : distance;
    const bool smooth = form != ScreenWeightForm::kLinear;
    return rampAt(uv.x, width, smooth) * rampAt(uv.y, width, smooth);
}

} // namespace crossray
