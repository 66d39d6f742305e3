// SPDX-License-Identifier: GPL-3.0-or-later
// Audio outputs must never prevent the haptic output: outputs that the device lacks are not requested.
#include "Mixer/Desk/DeskListening.h"
#include <algorithm>
#include <utility>

namespace physvib {

bool DeskListening::isFree(int output) const {
    return output >= 0 && output < output_.deviceOutputs() &&
           std::ranges::find(mix_.strips, output, &Strip::output) == mix_.strips.end();
}

ListeningSettings DeskListening::wanted() const {
    ListeningSettings wanted = ofStudy_.value_or(ListeningSettings{});
    if (!ofStudy_ && std::ranges::all_of(choice_.monitor, [this](int output) { return isFree(output); }))
        wanted.contacts = choice_.monitor;
    wanted.contactDb = choice_.monitorDb;
    const auto has = [&](const std::vector<int>& those) {
        return std::ranges::find(those, choice_.marker) != those.end();
    };
    if (isFree(choice_.marker) && !has(wanted.noise) && !has(wanted.contacts))
        wanted.marks = {choice_.marker};
    return wanted;
}

std::string DeskListening::hearWanted() {
    const auto wanted = this->wanted();
    if (wanted == told_) return {};
    auto error = output_.hear(wanted);
    if (error.empty()) told_ = wanted;
    return error;
}

std::string DeskListening::hear(const ListeningSettings& ofStudy) {
    const auto before = std::exchange(ofStudy_, ofStudy);
    auto error = hearWanted();
    if (!error.empty()) ofStudy_ = before;
    return error;
}

void DeskListening::endStudy() {
    ofStudy_.reset();
    hearWanted();
}

std::string DeskListening::listen(const ListeningSettings& wanted, const DeviceChoice& choice) {
    if (auto error = output_.hear(wanted); !error.empty()) return error;
    told_ = wanted;
    choice_ = choice;
    onChange_();
    return {};
}

std::string DeskListening::monitor(std::vector<int> outputs, double db) {
    auto wanted = told_;
    auto choice = choice_;
    wanted.contacts = choice.monitor = std::move(outputs);
    wanted.contactDb = choice.monitorDb = db;
    return listen(wanted, choice);
}

std::string DeskListening::mark(int output) {
    auto wanted = told_;
    auto choice = choice_;
    choice.marker = output;
    wanted.marks = output < 0 ? std::vector<int>{} : std::vector{output};
    return listen(wanted, choice);
}

} // namespace physvib
