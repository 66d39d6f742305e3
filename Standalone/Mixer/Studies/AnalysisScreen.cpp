// SPDX-License-Identifier: GPL-3.0-or-later
// Shows results of the same analysis functions as `physvib analyse`.
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/Widgets/Cards.h"

namespace physvib {

namespace {

constexpr int analysisHeadHeight = 56, wordsWidth = 430;

std::vector<std::string> pathsOf(const std::vector<juce::File>& files) {
    std::vector<std::string> paths;
    for (const auto& file : files) paths.push_back(pathOf(file));
    return paths;
}

/// Names of the analyses that fit every file; an error line if there are none.
Result<std::vector<std::string>> fitting(const std::vector<juce::File>& files) {
    std::vector<std::string> names;
    bool isFirst = true;
    for (const auto& path : pathsOf(files)) {
        const auto table = loadCsvTable(path);
        if (!table) return Failure{table.error};
        const auto these = analysesFor(table.value);
        if (isFirst) names = these;
        isFirst = false;
        std::erase_if(names,
                      [&](const std::string& name) { return std::ranges::find(these, name) == these.end(); });
        if (names.empty())
            return Failure{path + ": expected trials of a study, or a table that physvib analyse takes"};
    }
    return names;
}

/// Removes pattern fills, which JUCE cannot draw, so that the colour below stays visible.
void withoutHatches(juce::XmlElement& svg) {
    for (auto* const part : svg.getChildIterator()) {
        if (part->getStringAttribute("fill").startsWith("url(")) part->setAttribute("fill", "none");
        withoutHatches(*part);
    }
}

} // namespace

AnalysisScreen::AnalysisScreen(MixerModel& model, const std::vector<juce::File>& files)
    : AnalysisScreen{model, "Analysis"} {
    addAll(*this, {&kind_, choose_.get()});
    analyse(files);
}

AnalysisScreen::AnalysisScreen(MixerModel& model, const juce::String& title, AnalysisReport report)
    : AnalysisScreen{model, title} {
    report_ = std::move(report);
    showWords();
}

AnalysisScreen::AnalysisScreen(MixerModel& model, const juce::String& title)
    : FullScreen{model, title}
    , title_{title} {
    kind_.setTitle("Kind of analysis");
    kind_.onChange = [this] { run(kind_.getText().toLowerCase().replaceCharacter(' ', '-').toStdString()); };
    choose_ = quietButton("Choose files", "Choose the files to be analysed", [this] { browse(); });
    close_ = quietButton("Close", "Close the analysis", [this] { close(); });
    words_.setTitle("Figures");
    words_.setMultiLine(true);
    words_.setReadOnly(true);
    words_.setCaretVisible(false);
    words_.setColour(juce::TextEditor::outlineColourId, juce::Colours::transparentBlack);
    words_.setEscapeAndReturnKeysConsumed(false);
    words_.setFont(text::font(text::medium));
    addAll(*this, {close_.get(), &silence_, &words_});
    prepareControls(*this);
    refresh();
}

bool AnalysisScreen::keyPressed(const juce::KeyPress& key) {
    if (!key.isKeyCode(juce::KeyPress::returnKey)) return false;
    close_->triggerClick();
    return true;
}

void AnalysisScreen::browse() {
    const auto folder = files_.empty() ? juce::SharedResourcePointer<UserFolder> {
        } -> place()
            : files_.front().getParentDirectory();
    askForFiles(*this, {"Trials of a study", ".csv", folder, false, {}, {}, true},
                [this](const juce::Array<juce::File>& files) {
                    analyse({files.begin(), files.end()});
                });
}

void AnalysisScreen::analyse(const std::vector<juce::File>& files) {
    files_ = files;
    kind_.clear(juce::dontSendNotification);
    const auto names = fitting(files);
    for (int id = 1; const auto& name : names.value) kind_.addItem(titleOf(name), id++);
    kind_.setEnabled(!names.value.empty());
    if (!names.value.empty()) return kind_.setSelectedId(1, juce::sendNotificationSync);
    report_ = {names.error};
    run({});
}

void AnalysisScreen::run(const std::string& name) {
    picture_.reset();
    if (!name.empty()) {
        AnalysisJob options;
        options.files = pathsOf(files_);
        report_ = physvib::analyse(name, options);
    }
    if (report_.error.empty() && report_.picture) {
        const auto svg = juce::parseXML(utf8(report_.picture()));
        withoutHatches(*svg);
        const auto text = svg->toString();
        picture_ = juce::Drawable::createFromImageData(text.toRawUTF8(), text.getNumBytesAsUTF8());
    }
    showWords();
    resized();
    repaint();
}

// The text has the colours of the current window.
void AnalysisScreen::showWords() {
    words_.clear();
    const auto say = [this](const juce::String& words, Shade tone) {
        words_.setColour(juce::TextEditor::textColourId, shade(*this, tone));
        words_.insertTextAtCaret(words);
    };
    if (report_.isSimulated) say("SIMULATED: a simulated observer answered, not a person\n\n", Shade::now);
    if (!report_.error.empty()) say(utf8(report_.error) + "\n", Shade::limit);
    say(utf8(report_.words), Shade::text);
    for (const auto& warning : report_.warnings) say("\n" + utf8(warning) + "\n", Shade::now);
    words_.setCaretPosition(0);
}

void AnalysisScreen::paint(juce::Graphics& g) {
    g.fillAll(shade(*this, Shade::ground));
    ink(g, *this, Shade::text, text::large, juce::Font::bold);
    auto title = files_.empty() ? title_ : files_.front().getFileName();
    if (files_.size() > 1) title << " and " << static_cast<int>(files_.size() - 1) << " more";
    g.drawText(title, titleArea_, juce::Justification::centredLeft, true);
    if (const auto* const whole = dynamic_cast<const juce::DrawableComposite*>(picture_.get())) {
        constexpr int place = juce::RectanglePlacement::xMid | juce::RectanglePlacement::yTop;
        // not fitted by its bounds, which rotated text exceeds
        whole->draw(g, 1.0f,
                    juce::RectanglePlacement{place}.getTransformToFit(whole->getContentArea(),
                                                                      pictureArea_.toFloat()));
    }
}

void AnalysisScreen::resized() {
    auto area = getLocalBounds().reduced(pageInset, 16);
    auto head = area.removeFromTop(analysisHeadHeight - 16);
    silence_.setBounds(head.removeFromRight(160).translated(0, -8));
    head.removeFromRight(16);
    close_->setBounds(head.removeFromRight(90));
    choose_->setBounds(head.removeFromRight(130));
    kind_.setBounds(head.removeFromRight(200).withSizeKeepingCentre(190, rowHeight));
    titleArea_ = head;
    area.removeFromTop(16);
    words_.setBounds(picture_ == nullptr ? area
                                         : area.removeFromLeft(std::min(wordsWidth, area.getWidth() / 2)));
    pictureArea_ = area.withTrimmedLeft(24);
}

} // namespace physvib
