// SPDX-License-Identifier: GPL-3.0-or-later
// The screen with the results of an analysis, which `physvib analyse` prints on a terminal.
#include "Mixer/Studies/StudiesTab.h"
#include "Mixer/Widgets/Cards.h"

namespace physvib {

namespace {

constexpr int analysisHeaderHeight = 56, resultTextWidth = 430;

std::vector<std::string> toPaths(const std::vector<juce::File>& files) {
    std::vector<std::string> paths;
    for (const auto& file : files) paths.push_back(pathOf(file));
    return paths;
}

/// Names of the analyses that fit every file; an error line if there are none.
Result<std::vector<std::string>> findFittingAnalyses(const std::vector<juce::File>& files) {
    std::vector<std::string> names;
    bool isFirstFile = true;
    for (const auto& path : toPaths(files)) {
        const auto table = loadCsvTable(path);
        if (!table) return Failure{table.error};
        const auto fileAnalyses = analysesFor(table.value);
        if (isFirstFile) names = fileAnalyses;
        isFirstFile = false;
        std::erase_if(names, [&](const std::string& name) {
            return std::ranges::find(fileAnalyses, name) == fileAnalyses.end();
        });
        if (names.empty())
            return Failure{path + ": expected trials of a study, or a table that physvib analyse takes"};
    }
    return names;
}

/// Removes pattern fills, which JUCE cannot draw, so that the colour below stays visible.
void removeHatches(juce::XmlElement& svg) {
    for (auto* const element : svg.getChildIterator()) {
        if (element->getStringAttribute("fill").startsWith("url(")) element->setAttribute("fill", "none");
        removeHatches(*element);
    }
}

} // namespace

AnalysisScreen::AnalysisScreen(MixerModel& model, const std::vector<juce::File>& files)
    : AnalysisScreen{model, "Analysis"} {
    addAll(*this, {&analysisChoice_, chooseButton_.get()});
    analyse(files);
}

AnalysisScreen::AnalysisScreen(MixerModel& model, const juce::String& title, AnalysisReport report)
    : AnalysisScreen{model, title} {
    report_ = std::move(report);
    showReport();
}

AnalysisScreen::AnalysisScreen(MixerModel& model, const juce::String& title)
    : FullScreen{model, title}
    , title_{title} {
    analysisChoice_.setTitle("Kind of analysis");
    analysisChoice_.onChange = [this] {
        show(analysisChoice_.getText().toLowerCase().replaceCharacter(' ', '-').toStdString());
    };
    chooseButton_ = makeLinkButton("Choose files", "Choose the files to be analysed", [this] { browse(); });
    closeButton_ = makeLinkButton("Close", "Close the analysis", [this] { close(); });
    resultText_.setTitle("Figures");
    resultText_.setMultiLine(true);
    resultText_.setReadOnly(true);
    resultText_.setCaretVisible(false);
    resultText_.setColour(juce::TextEditor::outlineColourId, juce::Colours::transparentBlack);
    resultText_.setEscapeAndReturnKeysConsumed(false);
    resultText_.setFont(text::font(text::medium));
    addAll(*this, {closeButton_.get(), &silenceButton_, &resultText_});
    prepareControls(*this);
    refresh();
}

bool AnalysisScreen::keyPressed(const juce::KeyPress& key) {
    if (!key.isKeyCode(juce::KeyPress::returnKey)) return false;
    closeButton_->triggerClick();
    return true;
}

void AnalysisScreen::browse() {
    const auto folder = files_.empty() ? juce::SharedResourcePointer<UserFolder> {
        } -> location()
            : files_.front().getParentDirectory();
    askForFiles(*this, {"Trials of a study", ".csv", folder, false, {}, {}, true},
                [this](const juce::Array<juce::File>& files) {
                    analyse({files.begin(), files.end()});
                });
}

void AnalysisScreen::analyse(const std::vector<juce::File>& files) {
    files_ = files;
    analysisChoice_.clear(juce::dontSendNotification);
    const auto names = findFittingAnalyses(files);
    for (int id = 1; const auto& name : names.value) analysisChoice_.addItem(displayTitle(name), id++);
    analysisChoice_.setEnabled(!names.value.empty());
    if (!names.value.empty()) return analysisChoice_.setSelectedId(1, juce::sendNotificationSync);
    report_ = {names.error};
    show({});
}

void AnalysisScreen::show(const std::string& name) {
    picture_.reset();
    if (!name.empty()) {
        AnalysisJob job;
        job.files = toPaths(files_);
        report_ = physvib::analyse(name, job);
    }
    if (report_.error.empty() && report_.picture) {
        const auto svg = juce::parseXML(utf8(report_.picture()));
        removeHatches(*svg);
        const auto text = svg->toString();
        picture_ = juce::Drawable::createFromImageData(text.toRawUTF8(), text.getNumBytesAsUTF8());
    }
    showReport();
    resized();
    repaint();
}

// Writes the text anew, as it keeps the colours of the window in which it was written.
void AnalysisScreen::showReport() {
    resultText_.clear();
    const auto append = [this](const juce::String& line, Shade tone) {
        resultText_.setColour(juce::TextEditor::textColourId, shade(*this, tone));
        resultText_.insertTextAtCaret(line);
    };
    if (report_.isSimulated)
        append("SIMULATED: a simulated observer answered, not a person\n\n", Shade::highlight);
    if (!report_.error.empty()) append(utf8(report_.error) + "\n", Shade::limit);
    append(utf8(report_.text), Shade::text);
    for (const auto& warning : report_.warnings) append("\n" + utf8(warning) + "\n", Shade::highlight);
    resultText_.setCaretPosition(0);
}

void AnalysisScreen::paint(juce::Graphics& g) {
    g.fillAll(shade(*this, Shade::background));
    setInk(g, *this, Shade::text, text::large, juce::Font::bold);
    auto title = files_.empty() ? title_ : files_.front().getFileName();
    if (files_.size() > 1) title << " and " << static_cast<int>(files_.size() - 1) << " more";
    g.drawText(title, titleArea_, juce::Justification::centredLeft, true);
    if (const auto* const composite = dynamic_cast<const juce::DrawableComposite*>(picture_.get())) {
        constexpr int placement = juce::RectanglePlacement::xMid | juce::RectanglePlacement::yTop;
        // fitted by its content area, as rotated text exceeds the bounds
        composite->draw(g, 1.0f,
                        juce::RectanglePlacement{placement}.getTransformToFit(composite->getContentArea(),
                                                                              pictureArea_.toFloat()));
    }
}

void AnalysisScreen::resized() {
    auto area = getLocalBounds().reduced(pageInset, 16);
    auto header = area.removeFromTop(analysisHeaderHeight - 16);
    silenceButton_.setBounds(header.removeFromRight(silenceButtonWidth).translated(0, -8));
    header.removeFromRight(16);
    closeButton_->setBounds(header.removeFromRight(90));
    chooseButton_->setBounds(header.removeFromRight(130));
    analysisChoice_.setBounds(header.removeFromRight(200).withSizeKeepingCentre(190, rowHeight));
    titleArea_ = header;
    area.removeFromTop(16);
    resultText_.setBounds(
        picture_ == nullptr ? area : area.removeFromLeft(std::min(resultTextWidth, area.getWidth() / 2)));
    pictureArea_ = area.withTrimmedLeft(24);
}

} // namespace physvib
