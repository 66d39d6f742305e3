// SPDX-License-Identifier: MIT
// Stable sort by time for items of any type. One instance sorts all types, to keep the web page's code small.
#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace physvib {

/// Indices into `times`, earliest first. Any thread.
inline std::vector<std::size_t> timeOrder(std::span<const double> times) {
    std::vector<std::size_t> order(times.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto isEarlier = [&](std::size_t a, std::size_t b) { return times[a] < times[b]; };
    std::stable_sort(order.begin(), order.end(), isEarlier);
    return order;
}

/// `timeOf`: a member or function that gives a finite number. Any thread.
template <class T, class TimeOf>
void sortByTime(std::vector<T>& items, TimeOf timeOf) {
    std::vector<double> times;
    times.reserve(items.size());
    for (const T& item : items) times.push_back(static_cast<double>(std::invoke(timeOf, item)));
    if (std::is_sorted(times.begin(), times.end())) return;
    std::vector<T> sorted;
    sorted.reserve(items.size());
    for (const std::size_t i : timeOrder(times)) sorted.push_back(std::move(items[i]));
    items = std::move(sorted);
}

} // namespace physvib
