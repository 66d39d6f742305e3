// SPDX-License-Identifier: GPL-3.0-or-later
// Sends changes of the mixer state to the session as controls.
#include "Mixer/Desk/ToldMix.h"
#include "Live/Documents/Mix.h"
#include <algorithm>
#include <limits>
#include <memory>

namespace physvib {
namespace {

bool isSame(const PhantomPanner& a, const PhantomPanner& b) {
    return a.law() == b.law() && a.exponent() == b.exponent() &&
           (a.partLaw() == b.partLaw() || !hasParts(a.layout())) &&
           a.fieldWidthMetres() == b.fieldWidthMetres() && a.fieldHeightMetres() == b.fieldHeightMetres() &&
           isSame(a.layout(), b.layout());
}

} // namespace

void ToldMix::tell(Session& session, const Mix& mix) {
    using Kind = RenderControl::Kind;
    const auto post = [&session](Kind kind, const PhantomPanner* panner = nullptr) {
        return session.submit({RenderControl{0, kind, 0, 0.0f, panner}}).error.empty();
    };
    if (const auto panner = mix.panner(); !isSame(panner_, panner)) {
        // a channel may belong to another actuator now
        if (panner.channels() < panner_.channels() && !post(Kind::stopAll)) return;
        if (!post(Kind::panner, &panner)) return;
        panner_ = panner;
    }
    const auto felt = feltStrips(mix);
    for (std::size_t j = 0; j < follows_.size(); ++j)
        if (follows_[j]) strips_[j].gain = channelGain(felt[j]); // set by its lane
    tellStrips(strips_, felt,
               [&session](const RenderControl& control) { return session.submit({control}).error.empty(); });
}

void ToldMix::follow(Session& session, const Mix& mix) {
    std::vector<bool> follows(mix.strips.size());
    for (std::size_t j = 0; j < follows.size(); ++j) follows[j] = hasLane(mix, j);
    for (std::size_t j = 0; j < follows_.size(); ++j) // forget the gain, since the value at the end of its
                                                      // lane is unknown here
        if (follows_[j] && (j >= follows.size() || !follows[j]))
            strips_[j].gain = std::numeric_limits<float>::quiet_NaN();
    const bool any = std::ranges::find(follows, true) != follows.end(),
               wereAny = std::ranges::find(follows_, true) != follows_.end();
    follows_ = std::move(follows);
    if (any || wereAny) session.submit({Lanes{any ? std::make_shared<const Mix>(mix) : nullptr}});
}

} // namespace physvib
