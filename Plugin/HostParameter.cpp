// SPDX-License-Identifier: GPL-3.0-or-later
// Converts a host's parameter points to steps, and to ramps where the host draws lines.
#include "HostParameter.h"
#include <utility>

namespace physvib {

void ParameterPoints::begin(PointSource* source, int frames) noexcept {
    source_ = source;
    const int before = std::exchange(frames_, frames);
    if (!source) return;
    for (std::size_t p = 0; p < lines_.size(); ++p) {
        Line& line = lines_[p];
        line.corner = read(p);
        const bool isEndTold = source->lastOfLine(p) >= frames - 1;
        line.isDrawn =
            isEndTold && allParameters()[p].choices.empty() && (line.wasEndTold || line.corner.frame == 0);
        if (line.wasEndTold) {
            line.from.frame -= before;
            draw(line, -1);
        }
        line.wasEndTold = isEndTold;
    }
}

void ParameterPoints::end() noexcept {
    phase_ = (phase_ + frames_) % longestStep;
    if (source_) return;
    for (Line& line : lines_) line.wasEndTold = false;
}

double ParameterPoints::take(std::size_t parameter) noexcept {
    Line& line = lines_[parameter];
    if (line.step < line.corner.frame) {
        const int at = line.step;
        draw(line, at);
        return line.from.normal + (line.corner.normal - line.from.normal) * (at - line.from.frame) /
                                      (line.corner.frame - line.from.frame);
    }
    line.from = line.corner;
    line.corner = read(parameter);
    draw(line, line.from.frame);
    return line.from.normal;
}

ParameterPoint ParameterPoints::read(std::size_t parameter) noexcept {
    for (ParameterPoint point; source_->next(parameter, point);)
        if (std::isfinite(point.normal)) return {std::clamp(point.frame, 0, frames_), point.normal};
    return {none, 0.0};
}

// The next multiple of the longest step behind `after`, if the line needs it.
void ParameterPoints::draw(Line& line, int after) const noexcept {
    line.step = none;
    if (!line.isDrawn || line.corner.frame == none || line.corner.frame - line.from.frame <= longestStep)
        return;
    const int step = (phase_ + after + longestStep) / longestStep * longestStep - phase_;
    if (step < line.corner.frame) line.step = step;
}

} // namespace physvib
