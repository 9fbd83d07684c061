#pragma once
// How libpbr uses threads that it doesn't have: callers bring them.

#include <functional>

namespace pbr {

/// Calls body(i) for every i in [0, count), in any order, perhaps at the same time. Results don't depend on
/// the order.
using ForEach = std::function<void(int count, const std::function<void(int)>& body)>;

/// One call after the other.
inline void for_each_in_turn(int count, const std::function<void(int)>& body) {
    for (int i = 0; i < count; ++i) body(i);
}

}  // namespace pbr
