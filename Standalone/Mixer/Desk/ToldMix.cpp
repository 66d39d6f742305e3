// SPDX-License-Identifier: GPL-3.0-or-later
// From the mix to the session's controls.
#include "Mixer/Desk/ToldMix.h"

namespace physvib {
namespace {

bool isSame(const PhantomPanner& a, const PhantomPanner& b) {
    return a.law() == b.law() && a.exponent() == b.exponent() && a.fieldWidthMetres() == b.fieldWidthMetres() && a.fieldHeightMetres() == b.fieldHeightMetres() &&
           isSame(a.layout(), b.layout());
}

} // namespace

void ToldMix::tell(Session& session, const Mix& mix) {
    using Kind = RenderControl::Kind;
    const auto post = [&session](Kind kind, const PhantomPanner& panner) { return session.take({RenderControl{0, kind, 0, 0.0f, panner}}).error.empty(); };
    if (const auto panner = mix.panner(); !isSame(panner_, panner)) {
        if (panner.channels() < panner_.channels() && !post(Kind::stopAll, {})) return; // a channel may be another enchanter's now
        if (!post(Kind::panner, panner)) return;
        panner_ = panner;
    }
    tellStrips(strips_, mix.strips, [&session](const RenderControl& control) { return session.take({control}).error.empty(); });
}

} // namespace physvib
