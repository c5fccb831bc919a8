// Values by key, of which the least recently used are dropped when there are too many.
#pragma once

#include <cstddef>
#include <list>
#include <string>
#include <unordered_map>
#include <utility>

namespace crossray {

template <typename Value>
class LruCache {
  public:
    // A value with its key becomes the most recently used one. Null when there is none. The pointer holds until trim().
    Value* find(const std::string& key)
    {
        const auto found = places_.find(key);
        if (found == places_.end()) return nullptr;
        order_.splice(order_.begin(), order_, found->second);
        return &found->second->second;
    }

    // The key is not in the cache yet. Drops nothing, so that a caller may hold more values than the limit while it
    // works.
    Value& insert(const std::string& key, Value value)
    {
        order_.emplace_front(key, std::move(value));
        places_.emplace(key, order_.begin());
        return order_.front().second;
    }

    // Drops the least recently used values beyond `limit`.
    void trim(size_t limit)
    {
        while (order_.size() > limit) {
            places_.erase(order_.back().first);
            order_.pop_back();
        }
    }

    size_t size() const { return order_.size(); }

  private:
    std::list<std::pair<std::string, Value>> order_; // the most recently used first
    std::unordered_map<std::string, typename std::list<std::pair<std::string, Value>>::iterator> places_;
};

} // namespace crossray
