// SPDX-License-Identifier: GPL-3.0-or-later
// Messages wait for each other, so that none is lost and no two share a line.
#include "Mixer/Desk/DeskMessages.h"

namespace physvib {

void DeskMessages::show(DeskMessage message) {
    const bool isDone = message.words.isEmpty();
    if (isDone && !waiting_.empty()) {
        message = std::move(waiting_.front());
        waiting_.pop_front();
    } else if (!isDone && !shown_.isNews && shown_.act.run && shown_.words != message.words)
        waiting_.push_front(shown_); // there is still something to be done about it
    const bool isSame = message.words == shown_.words && message.isNews == shown_.isNews &&
                        message.act.name == shown_.act.name;
    shown_ = std::move(message);
    if (!isSame) onChange_();
}

void DeskMessages::add(DeskMessage message) {
    if (shown_.words.isEmpty()) return show(std::move(message));
    waiting_.push_back(std::move(message));
}

void DeskMessages::withdraw(const juce::String& words) {
    std::erase_if(waiting_, [&](const DeskMessage& m) { return m.words.startsWith(words); });
    if (shown_.words.startsWith(words)) show({});
}

} // namespace physvib
