// Which case is asked next: the one that is likeliest to catch a mutant for its time, by what it caught before in the
// same function and file.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace crossray {

// Thread-safe, but for a Choice.
class CaseOdds {
  public:
    explicit CaseOdds(size_t cases) : cases_(cases) {}

    // The order for one mutant; `likely` are those of the candidates that were written for its file.
    class Choice {
      public:
        // Nothing when all have been asked or dropped. `milliseconds` estimates what a case takes.
        std::optional<size_t> next(const std::function<double(size_t)>& milliseconds);
        void note(size_t testCase, bool isCaught);
        void dropIf(const std::function<bool(size_t)>& isDropped);

      private:
        friend class CaseOdds;
        CaseOdds* odds_ = nullptr;
        std::string file_, function_;
        std::vector<size_t> left_;
        std::set<size_t> likely_;
    };
    Choice start(std::string file, std::string function, std::vector<size_t> candidates, std::set<size_t> likely = {});

  private:
    struct Record {
        double asked = 0, caught = 0;
    };
    using Records = std::vector<Record>; // by case
    Records& recordsOf(const std::string& key);

    size_t cases_;
    std::mutex mutex_;
    std::map<std::string, Records> records_; // by file, and by file and function
};

} // namespace crossray
