// SPDX-License-Identifier: GPL-3.0-or-later
// Messages wait for each other, so that none is lost and no two share a line.
#include "Mixer/Desk/DeskMessages.h"
#include <algorithm>

namespace physvib {
namespace {

bool isOf(const DeskMessage& message, const juce::String& label) {
    return label.isNotEmpty() && message.label == label;
}

} // namespace

void DeskMessages::put(DeskMessage message) {
    const bool isSame = message.words == shown_.words && message.isNews == shown_.isNews &&
                        message.act.name == shown_.act.name;
    shown_ = std::move(message);
    if (!isSame) onChange_();
}

void DeskMessages::show(DeskMessage message) {
    const bool isDone = message.words.isEmpty();
    std::erase_if(waiting_, [&](const DeskMessage& m) { return isOf(m, message.label); });
    if (isDone && !waiting_.empty()) {
        message = std::move(waiting_.front());
        waiting_.pop_front();
    } else if (!isDone && !shown_.isNews && (shown_.act.run || shown_.label.isNotEmpty()) &&
               shown_.words != message.words && !isOf(shown_, message.label))
        waiting_.push_front(shown_); // there is still something to be done about it
    put(std::move(message));
}

void DeskMessages::add(DeskMessage message) {
    if (shown_.words.isEmpty() || isOf(shown_, message.label)) return put(std::move(message));
    const auto same =
        std::ranges::find_if(waiting_, [&](const DeskMessage& m) { return isOf(m, message.label); });
    if (same != waiting_.end())
        *same = std::move(message);
    else
        waiting_.push_back(std::move(message));
}

void DeskMessages::withdraw(const juce::String& label) {
    std::erase_if(waiting_, [&](const DeskMessage& m) { return isOf(m, label); });
    if (isOf(shown_, label)) show({});
}

} // namespace physvib
