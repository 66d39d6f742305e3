// SPDX-License-Identifier: GPL-3.0-or-later
// The mixer's world as a link to the web page, which opens it with the same samples.
#pragma once
#include "Io/Result.h"
#include "Live/Documents/Mix.h"
#include <juce_events/juce_events.h>

namespace physvib {

/// The part of the page's address behind the #: scene as drawn, seed, actuators and law. Or one line with
/// what a link cannot hold. Places are rounded to thousandths of the field, as the page does. Any thread.
Result<std::string> pageLink(const Mix& mix, const Scene& drawn);

/// Whether an address of a page is of this computer alone.
bool isLoopback(const juce::String& address);

/// Opens it, unchanged, in the system's browser. Message thread.
void openLink(juce::String link);

/// Serves the page by https to this network, by its serve.py, until it goes.
class PageServer {
public:
    ~PageServer() { program_.kill(); }
    /// Whether there is a page: in the tree where the mixer was built, in a release's folder physvib-page in
    /// or above the mixer's, or installed beside it in share/physvib. Any thread.
    static bool isThere() { return page() != juce::File{}; }
    /// The page's address for others, or one line. May wait for a second: not on the message thread.
    Result<std::string> begin();

private:
    static juce::File page();
    juce::ChildProcess program_;
};

} // namespace physvib
