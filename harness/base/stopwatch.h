// Wall clock between laps.
#pragma once

#include <chrono>

namespace crossray {

inline double millisecondsSince(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

class Stopwatch {
  public:
    // Milliseconds since the last lap, or since the watch was made.
    double lap()
    {
        const auto now = Clock::now();
        const std::chrono::duration<double, std::milli> passed = now - last_;
        last_ = now;
        return passed.count();
    }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_ = Clock::now();
};

} // namespace crossray
