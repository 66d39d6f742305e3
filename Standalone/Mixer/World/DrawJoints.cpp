// SPDX-License-Identifier: GPL-3.0-or-later
// Creates joints between bodies, or between a body and the field.
#include "Mixer/Desk/DeskWords.h"
#include "Mixer/World/DrawPane.h"
#include "Scene/Drawing/DrawnBodies.h"
#include <algorithm>

namespace physvib {

// The field itself is not a body. A joint to it uses a static body, or a small disc that is added there.
std::string DrawPane::fieldBody(std::vector<Action>& actions, const Vector& place) {
    for (const auto& body : desk_.world().drawing().drawn().bodies)
        if (body.type == BodyType::staticBody) return body.name;
    const double size = std::max(0.011, 0.01 * desk_.world().scene().fieldHeightMetres);
    auto disc = drawnBall(place, {place.x + size, place.y}).value;
    disc.type = BodyType::staticBody;
    disc.name = desk_.world().drawing().freeName("pin");
    disc.fixtures[0].material = material_;
    actions.push_back(SpawnAction{disc, {}});
    return disc.name;
}

void DrawPane::joinAt(DrawTool tool, Vector place) {
    const DrawTool before = tool_;
    use(tool);
    to_ = place;
    if (tool == DrawTool::spring) { // hangs from a place above
        constexpr double length = 0.2;
        stroke_ = {place};
        to_.y += length * desk_.world().scene().fieldHeightMetres;
    }
    join();
    stroke_.clear();
    use(before);
}

void DrawPane::join() {
    const Vector from = stroke_.empty() ? to_ : stroke_[0];
    const bool isPoint = tool_ == DrawTool::pin || tool_ == DrawTool::motor;
    const auto known = [&](const Vector& place) {
        auto names = view_.bodiesAt(view_.placeOfMetres(place));
        std::erase_if(names,
                      [&](const std::string& name) { return desk_.world().drawing().find(name) == nullptr; });
        return names;
    };
    const auto first = known(from), second = isPoint ? first : known(to_);
    const std::size_t other = isPoint ? 1 : 0;
    if (first.empty() && (second.empty() || tool_ == DrawTool::slider))
        return desk_.report("A joint: expected a body there");
    std::vector<Action> actions;
    std::string b = first.empty() ? std::string{} : first[0],
                a = second.size() > other && second[other] != b ? second[other] : std::string{};
    if (tool_ == DrawTool::slider) a.clear(); // its axis is fixed to the field
    if (b.empty()) b = fieldBody(actions, from);
    if (a.empty()) a = fieldBody(actions, isPoint ? from : to_);
    SceneDrawing trial = desk_.world().drawing();
    for (const Action& action : actions) trial.take(action);
    const auto place = [&](const std::string& name) {
        const auto now = placeNow(name);
        const auto* body = trial.find(name);
        return std::pair{name, now    ? *now
                               : body ? BodyPlace{body->positionMetres, body->angleRadians}
                                      : BodyPlace{}};
    };
    const auto kind = tool_ == DrawTool::pin      ? JointKind::pin
                      : tool_ == DrawTool::motor  ? JointKind::motor
                      : tool_ == DrawTool::rope   ? JointKind::rope
                      : tool_ == DrawTool::spring ? JointKind::spring
                                                  : JointKind::slider;
    const bool isTurnedRound = tool_ == DrawTool::rope || tool_ == DrawTool::spring; // the stroke begins on b
    auto made =
        joined(trial, kind, place(a), place(b), isTurnedRound ? to_ : from, isTurnedRound ? from : to_);
    if (!made) return desk_.report(utf8(made.error));
    actions.insert(actions.end(), made.value.begin(), made.value.end());
    edit(wordsOf(tool_).name, std::move(actions));
}

} // namespace physvib
