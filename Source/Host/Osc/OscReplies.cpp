// SPDX-License-Identifier: GPL-3.0-or-later
// Counts the reply bytes of the last second for each sender.
#include "Host/Osc/OscReplies.h"
#include <algorithm>
#include <numeric>

namespace physvib {
namespace {

bool isThisComputer(std::string_view sender) {
    return sender.starts_with("127.") || sender.starts_with("::1:");
}

} // namespace

void OscReplies::begin(std::string_view sender, std::size_t bytes, std::int64_t nowNs) {
    nowNs_ = nowNs;
    bytesLeft_ = bytes;
    current_ = find(isThisComputer(sender) ? sender : sender.substr(0, sender.rfind(':')));
    if (current_ == nullptr) return;
    current_->lastNs = nowNs;
    std::erase_if(current_->spent, [nowNs](const Spent& one) { return one.atNs <= nowNs - secondNs; });
}

// A sender that was quiet for a second has spent nothing, so its place is reused.
OscReplies::Sender* OscReplies::find(std::string_view name) {
    const auto known = std::ranges::find(senders_, name, &Sender::name);
    if (known != senders_.end()) return &*known;
    const auto quiet = std::ranges::min_element(senders_, {}, &Sender::lastNs);
    if (senders_.size() < mostSenders)
        senders_.push_back({std::string(name), nowNs_, {}});
    else if (quiet->lastNs <= nowNs_ - secondNs)
        return &(*quiet = {std::string(name), nowNs_, {}});
    else
        return nullptr;
    return &senders_.back();
}

bool OscReplies::mayReply(std::size_t bytes) {
    const std::size_t beyond = bytes - std::min(bytes, bytesLeft_);
    const auto add = [](std::size_t sum, const Spent& one) { return sum + one.bytes; };
    if (current_ == nullptr ||
        std::accumulate(current_->spent.begin(), current_->spent.end(), beyond, add) > freeBytes)
        return ++heldBack_, false;
    bytesLeft_ -= bytes - beyond;
    if (beyond > 0) current_->spent.push_back({nowNs_, beyond});
    return true;
}

bool OscReplies::mayRefuse(std::string_view reason) {
    return (current_ != nullptr && current_->refusals.take(reason, nowNs_)) || (++heldBack_, false);
}

} // namespace physvib
