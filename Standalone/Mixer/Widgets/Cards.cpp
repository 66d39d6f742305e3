// SPDX-License-Identifier: GPL-3.0-or-later
// Lays out cards, finds the host that shows them, and closes a card before its answer is used.
#include "Mixer/Widgets/Cards.h"
#include "Io/Text/QrCode.h"
#include "Scene/SceneValidation.h"

namespace physvib {
namespace {

CardHost* hostOf(juce::Component& from) { return from.findParentComponentOfClass<CardHost>(); }

using From = juce::Component::SafePointer<juce::Component>;

/// Closes the card after the click of its button was handled, then calls `then`.
void closeThen(const From& from, std::function<void()> then) {
    if (from == nullptr) return;
    later(*from, [then = std::move(then)](juce::Component& asking) {
        if (auto* host = hostOf(asking)) host->setCard(nullptr);
        if (then) then();
    });
}

constexpr int looksPerSecond = 15;

} // namespace

void askForFile(juce::Component& from, const FileCard::Choice& choice,
                std::function<void(const juce::File&)> use, std::function<void()> cancelled) {
    askForFiles(
        from, choice, [use = std::move(use)](const juce::Array<juce::File>& files) { use(files[0]); },
        std::move(cancelled));
}

void askForFiles(juce::Component& from, const FileCard::Choice& choice,
                 const std::function<void(const juce::Array<juce::File>&)>& use,
                 std::function<void()> cancelled) {
    auto* host = hostOf(from);
    if (host == nullptr) return;
    auto card = std::make_unique<FileCard>(choice);
    card->onCancel = [safe = From{&from}, cancelled = std::move(cancelled)] { closeThen(safe, cancelled); };
    card->onFiles = [safe = From{&from}, use](const juce::Array<juce::File>& files) {
        closeThen(safe, [use, files] { use(files); });
    };
    host->setCard(std::move(card));
}

void askForValues(juce::Component& from, const juce::String& title, const juce::String& answer,
                  const std::vector<QuestionCard::Field>& fields,
                  std::function<void(const juce::StringArray&)> use, const juce::String& words) {
    auto* host = hostOf(from);
    if (host == nullptr) return;
    const auto card = std::make_shared<juce::Component::SafePointer<QuestionCard>>();
    const auto accept = [safe = From{&from}, card, fields, use = std::move(use)] {
        juce::StringArray values;
        for (const auto& field : fields) values.add((*card)->value(field.title));
        closeThen(safe, [use, values] { use(values); });
    };
    std::vector<QuestionCard::Answer> answers{{answer, accept},
                                              {"Cancel", [safe = From{&from}] { closeThen(safe, {}); }, true,
                                               juce::KeyPress{juce::KeyPress::escapeKey}}};
    auto made = std::make_unique<QuestionCard>(title, words, std::move(answers), fields);
    *card = made.get();
    host->setCard(std::move(made));
}

juce::Image qrPicture(const std::string& link) {
    constexpr int most = mostPicture; // the longest has 177 modules
    QrCode code{link};
    if (code.side() == 0) return {};
    const int side = code.side() + 2 * QrCode::quietModules, each = std::min(6, most / side);
    juce::Image picture{juce::Image::RGB, side * each, side * each, false};
    juce::Graphics g{picture};
    g.fillAll(juce::Colours::white);
    g.setColour(juce::Colours::black);
    for (int y = 0; y < code.side(); ++y)
        for (int x = 0; x < code.side(); ++x)
            if (code.isDark(x, y))
                g.fillRect((x + QrCode::quietModules) * each, (y + QrCode::quietModules) * each, each, each);
    return picture;
}

Card::Card(int width)
    : width_{width} {
    setWantsKeyboardFocus(true);
    title_.setFont(text::font(text::large, juce::Font::bold));
    words_.setFont(text::font(text::medium));
    words_.setJustificationType(juce::Justification::topLeft);
    words_.setMinimumHorizontalScale(1.0f); // it has space for all lines
    for (auto* label : {&title_, &words_}) {
        label->setBorderSize({0, 0, 0, 0}); // one line with the fields
        addAndMakeVisible(label);
    }
}

void Card::say(const juce::String& title, const juce::String& words) {
    setTitle(title);
    setDescription(words);
    title_.setText(title, quietly);
    words_.setText(words, quietly);
}

void Card::setAnswers(std::vector<juce::TextButton*> answers) {
    for (auto* button : answers_) button->setVisible(false);
    answers_ = std::move(answers);
    for (auto* button : answers_) {
        if (button->getTitle().isEmpty()) button->setTitle(button->getButtonText());
        button->setToggleState(button == answers_.front() && button->isEnabled(), quietly);
        addAndMakeVisible(button);
    }
}

void Card::fit() {
    prepareControls(*this);
    const auto middle = getBounds().getCentre();
    const int lineHigh =
        words().isEmpty() ? 0 : 18 + text::high(words_.getFont(), words(), width_ - 2 * edgeX - 4);
    const int high = 2 * edgeY + titleHigh + lineHigh + contentHigh() + gap + answersHigh();
    const auto beside = aside();
    setSize(width_ + (beside.x > 0 ? edgeX + beside.x : 0), std::max(high, beside.y + 2 * edgeY));
    setCentrePosition(middle);
    resized();
    repaint();
}

void Card::resized() {
    // what is aside is at the left: the first answer is at the card's right edge
    auto area = getLocalBounds().reduced(edgeX, edgeY);
    area = area.withLeft(area.getRight() - (width_ - 2 * edgeX));
    title_.setBounds(area.removeFromTop(titleHigh));
    const int width = (area.getWidth() - (perRow() - 1) * gap) / perRow();
    const auto rows = area.removeFromBottom(answersHigh());
    for (int k = 0; k < static_cast<int>(answers_.size()); ++k)
        nth(answers_, k)
            ->setBounds(rows.getRight() - width - k % perRow() * (width + gap),
                        rows.getY() + k / perRow() * (rowHigh + gap), width, rowHigh);
    area.removeFromBottom(gap);
    place(area.removeFromBottom(contentHigh()));
    words_.setBounds(area.withTrimmedTop(4));
}

FileCard::FileCard(const Choice& choice)
    : Card{wide}
    , choice_{choice} {
    say(choice.title, {});
    place_.setTitle("Folder");
    fault_.setTitle("What is wrong");
    list_.setTitle("Files of the folder");
    list_.setRowHeight(rowHeight);
    list_.setMultipleSelectionEnabled(choice.areSeveral);
    name_.setTitle("Name of the file");
    name_.setFont(text::font(text::medium));
    name_.setText(choice.name, false);
    name_.setSelectAllWhenFocused(true);
    name_.setTextToShowWhenEmpty("name or path", juce::Colours::grey);
    name_.onReturnKey = [this] { accept(); };
    name_.onEscapeKey = [this] { onCancel(); };
    name_.onTextChange = [this] {
        replaced_ = juce::File{};
        accept_.setButtonText(acceptWords());
        showFault({}, Shade::text);
    };
    up_.setTitle("Parent folder");
    up_.onClick = [this] { enter(folder_.getParentDirectory()); };
    accept_.setButtonText(acceptWords());
    accept_.onClick = [this] { accept(); };
    cancel_.onClick = [this] { onCancel(); };
    addAll(*this, {&place_, &up_, &list_, &name_, &fault_});
    setAnswers({&accept_, &cancel_});
    enter(choice.folder);
}

bool FileCard::hasEnding(const juce::File& file) const {
    return !isFolder() && (file.hasFileExtension(choice_.ending) ||
                           std::ranges::any_of(choice_.endings, [&](const juce::String& ending) {
                               return file.hasFileExtension(ending);
                           }));
}

void FileCard::enter(const juce::File& folder) {
    folder_ = folder.isDirectory() ? folder : juce::File::getSpecialLocation(juce::File::userHomeDirectory);
    entries_ = folder_.findChildFiles(juce::File::findDirectories | juce::File::ignoreHiddenFiles, false);
    entries_.sort();
    auto files = folder_.findChildFiles(juce::File::findFiles | juce::File::ignoreHiddenFiles, false);
    files.sort();
    for (const auto& file : files)
        if (hasEnding(file)) entries_.add(file);
    place_.setText(folder_.getFullPathName(), quietly);
    list_.deselectAllRows();
    list_.updateContent();
    list_.repaint();
    showFault(!entries_.isEmpty() ? juce::String{}
              : isFolder()        ? juce::String{"No folders here"}
                                  : "No folders or " + choice_.ending + " files here",
              Shade::muted);
    rows_ = std::max(rows_, std::clamp(entries_.size(), fewRows, mostRows));
    fit();
}

void FileCard::accept() {
    const int row = list_.getSelectedRow();
    if (list_.getNumSelectedRows() > 1) {
        juce::Array<juce::File> files;
        for (int k = 0; k < entries_.size(); ++k)
            if (list_.isRowSelected(k) && !entries_[k].isDirectory()) files.add(entries_[k]);
        if (files.size() > 1) return onFiles(files);
    }
    if (juce::isPositiveAndBelow(row, entries_.size()) && entries_[row].isDirectory())
        return enter(entries_[row]);
    if (name().isEmpty()) return isFolder() ? onFiles({folder_}) : showFault("Expected a name", Shade::limit);
    const auto typed = folder_.getChildFile(name()); // or an absolute path
    if (typed.isDirectory()) return enter(typed);
    if (isFolder())
        return showFault(typed.getFullPathName() + ": expected a folder that is there", Shade::limit);
    const auto file = hasEnding(typed) ? typed : typed.getSiblingFile(typed.getFileName() + choice_.ending);
    if (!choice_.isSaving)
        return file.existsAsFile()
                   ? onFiles({file})
                   : showFault(file.getFileName() + ": expected a file that is there", Shade::limit);
    if (!file.getParentDirectory().isDirectory())
        return showFault(file.getParentDirectory().getFullPathName() + ": expected a folder that is there",
                         Shade::limit);
    if (file.existsAsFile() && file != replaced_) {
        replaced_ = file;
        accept_.setButtonText("Replace");
        return showFault(file.getFileName() + " exists. Press again to replace it", Shade::now);
    }
    onFiles({file});
}

void FileCard::showFault(const juce::String& words, Shade which) {
    fault_.setText(words, quietly);
    fault_.setTone(which);
}

bool FileCard::keyPressed(const juce::KeyPress& key) {
    if (key == juce::KeyPress::escapeKey) return onCancel(), true;
    if (key == juce::KeyPress::returnKey) return accept(), true;
    if (key == juce::KeyPress::backspaceKey) return enter(folder_.getParentDirectory()), true;
    return false;
}

void FileCard::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= entries_.size()) return;
    auto area = juce::Rectangle<int>{width, height};
    if (isSelected) drawChosenRow(g, *this, width, height, 0.22f);
    const auto& entry = entries_[row];
    const bool isFolder = entry.isDirectory();
    area.reduce(12, 0);
    ink(g, *this, Shade::muted, text::small);
    g.drawText(isFolder ? juce::String{"folder"}
                        : entry.getLastModificationTime().formatted("%Y-%m-%d %H:%M"),
               area.removeFromRight(120), juce::Justification::centredRight, true);
    ink(g, *this, Shade::text, text::medium, isFolder ? juce::Font::bold : juce::Font::plain);
    g.drawText(entry.getFileName(), area, juce::Justification::centredLeft, true);
}

void FileCard::place(juce::Rectangle<int> area) {
    auto row = area.removeFromTop(rowHeight);
    up_.setBounds(row.removeFromRight(70));
    place_.setBounds(row.withTrimmedRight(gap));
    fault_.setBounds(area.removeFromBottom(rowHeight));
    area.removeFromBottom(gap);
    name_.setBounds(area.removeFromBottom(rowHeight));
    list_.setBounds(area.withTrimmedTop(8).withTrimmedBottom(gap));
}

/// A field with its title.
class QuestionCard::Input final : public juce::Component {
public:
    explicit Input(const Field& field)
        : name{field.title}
        , dots{field.dots} {
        text.setTitle(name);
        text.setFont(physvib::text::font(physvib::text::medium));
        text.setText(field.value, false);
        text.setSelectAllWhenFocused(true);
        if (field.allowed.isNotEmpty()) text.setInputRestrictions(32, field.allowed);
        list.setTitle(name);
        for (int k = 0; k < field.choices.size(); ++k) {
            juce::PopupMenu::Item item{field.choices[k]};
            item.itemID = k + 1;
            if (!dots.empty()) item.image = dotOf(nth(dots, k));
            list.getRootMenu()->addItem(std::move(item));
        }
        list.setText(field.value, quietly);
        addAndMakeVisible(control());
    }
    juce::Component& control() { return list.getNumItems() > 0 ? static_cast<juce::Component&>(list) : text; }
    juce::String value() const { return list.getNumItems() > 0 ? list.getText() : text.getText().trim(); }
    void paint(juce::Graphics& g) override {
        ink(g, *this, Shade::muted, physvib::text::small);
        g.drawText(name, getLocalBounds().withWidth(nameWidth), juce::Justification::centredLeft, true);
    }
    void paintOverChildren(juce::Graphics& g) override {
        if (const int k = list.getSelectedItemIndex(); k >= 0 && k < static_cast<int>(dots.size()))
            dotOf(nth(dots, k))
                ->drawAt(g, static_cast<float>(getWidth()) - 56.0f,
                         0.5f * static_cast<float>(getHeight() - dot), 1.0f);
    }
    void resized() override { control().setBounds(getLocalBounds().withTrimmedLeft(nameWidth)); }

    static constexpr int nameWidth = 130, dot = 16;
    static std::unique_ptr<juce::Drawable> dotOf(juce::Colour colour) {
        auto picture = std::make_unique<juce::DrawablePath>();
        juce::Path circle;
        circle.addEllipse(0.0f, 0.0f, dot, dot);
        picture->setPath(circle);
        picture->setFill(colour);
        return picture;
    }
    const juce::String name;
    const std::vector<juce::Colour> dots;
    juce::TextEditor text;
    juce::ComboBox list;
};

QuestionCard::~QuestionCard() = default;

QuestionCard::QuestionCard(const juce::String& title, const juce::String& words, std::vector<Answer> answers,
                           const std::vector<Field>& fields)
    : Card{wide}
    , answers_{std::move(answers)} {
    say(title, words);
    std::vector<juce::TextButton*> shown;
    if (!answers_.front().key.isValid()) answers_.front().key = juce::KeyPress{juce::KeyPress::returnKey};
    for (std::size_t k = 0; k < answers_.size(); ++k) {
        const Answer& answer = answers_[k];
        auto& button = *buttons_.emplace_back(std::make_unique<juce::TextButton>(answer.words));
        if (answer.key.isValid())
            button.setTooltip(answer.words + " (" + answer.key.getTextDescription() + ")");
        button.setEnabled(answer.isEnabled);
        button.onClick = [this, k] { act(k); };
        shown.push_back(&button);
    }
    setAnswers(std::move(shown));
    for (const Field& field : fields) {
        auto& added = *inputs_.emplace_back(std::make_unique<Input>(field));
        addAndMakeVisible(added);
        if (field.onChange)
            added.list.onChange =
                added.text.onTextChange = [this, &added, use = field.onChange] { use(*this, added.value()); };
        added.text.onReturnKey = [this] { keyPressed(juce::KeyPress{juce::KeyPress::returnKey}); };
        added.text.onEscapeKey = [this] { keyPressed(juce::KeyPress{juce::KeyPress::escapeKey}); };
    }
    fit();
}

void QuestionCard::setPicture(const juce::Image& picture, const juce::String& without) {
    picture_ = picture;
    without_ = without;
    fit();
}

juce::String QuestionCard::value(const juce::String& field) const {
    for (const auto& input : inputs_)
        if (input->name == field) return input->value();
    return {};
}

void QuestionCard::setValue(const juce::String& field, const juce::String& value) {
    for (auto& input : inputs_)
        if (input->name == field) {
            input->text.setText(value, false);
            input->list.setText(value, quietly);
        }
}

void QuestionCard::enable(const juce::String& answer, bool isEnabled) {
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (answers_[k].words == answer) buttons_[k]->setEnabled(answers_[k].isEnabled = isEnabled);
}

void QuestionCard::answer(const juce::String& words) {
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (answers_[k].words == words) return act(k);
}

// Asynchronous, because the button's click is still being handled and the action may destroy the card.
void QuestionCard::act(std::size_t which) {
    if (!answers_[which].isEnabled) return;
    later(*this, [which](QuestionCard& card) {
        const auto act = card.answers_[which].act;
        act();
    });
}

bool QuestionCard::keyPressed(const juce::KeyPress& key) {
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (buttons_[k]->hasKeyboardFocus(false) && key == juce::KeyPress::returnKey) return act(k), true;
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (key == answers_[k].key) return act(k), true;
    return false;
}

void QuestionCard::paint(juce::Graphics& g) {
    Card::paint(g);
    g.setImageResamplingQuality(juce::Graphics::lowResamplingQuality); // sharp on finer screens
    const auto room = juce::Rectangle<int>{edgeX, edgeY, aside().x, aside().y};
    const auto at = picture_.getBounds().withCentre(room.getCentre());
    if (picture_.isValid()) return g.drawImageAt(picture_, at.getX(), at.getY());
    ink(g, *this, Shade::muted, text::medium);
    g.drawFittedText(without_, room, juce::Justification::centred, 4, 1.0f);
}

void QuestionCard::place(juce::Rectangle<int> content) {
    for (auto& input : inputs_) {
        input->setBounds(content.removeFromTop(rowHeight));
        content.removeFromTop(gap);
    }
}

RenderTask::RenderTask(const juce::File& file, Work work, Done done)
    : juce::Thread{"PhysVib render"}
    , file_{file}
    , work_{std::move(work)}
    , done_{std::move(done)} {
    juce::Component::setTitle("Progress");
    cancel_.setTitle("Cancel the making of the file");
    cancel_.onClick = [this] {
        cancel_.setEnabled(false);
        signalThreadShouldExit();
    };
    addAndMakeVisible(cancel_);
    prepareControls(*this);
    setSize(wide, high);
    startThread();
    startTimerHz(looksPerSecond);
}

RenderTask::~RenderTask() {
    constexpr int untilItHasEnded = -1;
    stopThread(untilItHasEnded);
}

void RenderTask::run() {
    error_ = work_([this](double share) {
        share_ = share;
        return !threadShouldExit();
    });
}

void RenderTask::timerCallback() {
    repaint();
    if (isThreadRunning()) return;
    stopTimer();
    const auto done = done_; // which may destroy this object and its error
    const auto error = error_;
    done(error, threadShouldExit());
}

void RenderTask::paint(juce::Graphics& g) {
    drawCard(g, *this);
    auto area = getLocalBounds().reduced(12, 8).withTrimmedRight(92);
    ink(g, *this, Shade::text, text::medium);
    const double share = juce::jlimit(0.0, 1.0, share_.load());
    g.drawText(file_.getFileName() + "  " + juce::String{juce::roundToInt(100.0 * share)} + " %",
               area.removeFromTop(24), juce::Justification::centredLeft, true);
    const auto bar = area.removeFromBottom(8).toFloat();
    fillRound(g, *this, Shade::line, bar, 4.0f);
    fillRound(g, *this, Shade::accent, bar.withWidth(bar.getWidth() * static_cast<float>(share)), 4.0f);
}

void askMaterial(juce::Component& from, MixerModel& model, int material, bool isCopy,
                 std::function<void(int material)> made) {
    static const juce::StringArray colours{"by its place", "red",  "amber", "light blue", "mauve",
                                           "tan",          "blue", "brown", "olive"};
    auto materials = model.world().drawing().drawn().materials;
    if (isCopy) materials.push_back(Material{nth(materials, material)});
    const auto index = isCopy ? materials.size() - 1 : static_cast<std::size_t>(material);
    const Material asked = materials[index];
    std::vector<juce::Colour> dots;
    for (int k = 0; k < colours.size(); ++k) {
        materials[index].colour = k;
        dots.push_back(palette::material(materials, static_cast<int>(index)));
    }
    const auto name = utf8(asked.name);
    askForValues(
        from, isCopy ? "A material of one's own" : "Name and colour", isCopy ? "Make it" : "Change",
        {{"Name", isCopy ? "own " + name : name}, {"Colour", colours[asked.colour], {}, colours, {}, dots}},
        [&model, material, isCopy, made = std::move(made)](const juce::StringArray& values) {
            constexpr double usualHz = 165.0, usualDecay = 22.0; // of one that begins as a silent one
            Scene scene = model.world().drawing().drawn();
            auto& all = scene.materials;
            const auto at = static_cast<std::size_t>(isCopy ? std::ssize(all) : material);
            if (isCopy) all.push_back(Material{nth(all, material)});
            Material& own = all[at];
            if (isCopy && own.frequencyHz <= 0.0) own.frequencyHz = usualHz, own.decayPerSecond = usualDecay;
            own.name = values[0].toStdString(), own.colour = colours.indexOf(values[1]);
            if (model.reportFault(validate(scene))) return;
            model.change(isCopy ? "New material" : "Name and colour",
                         [&](Mix& mix) { mix.scene = std::make_shared<const Scene>(std::move(scene)); });
            model.dispatchPendingMessages();
            made(static_cast<int>(at));
        },
        isCopy
            ? "It begins as a copy of " + name +
                  ": set its frequency, decay and surface, or measure a recording. Bodies start where they "
                  "were drawn."
            : "Bodies start where they were drawn.");
}

void showMaterialMenu(juce::Component& from, MixerModel& model, int material, std::function<void(int)> made,
                      std::function<void(bool isRecording)> open) {
    const auto& materials = model.world().drawing().drawn().materials;
    if (material < 0 || material >= static_cast<int>(materials.size())) return;
    const Material& asked = nth(materials, material);
    const auto ask = [safe = From{&from}, &model, material, made = std::move(made)](bool isCopy) {
        return [safe, &model, material, made, isCopy] {
            if (safe != nullptr) askMaterial(*safe, model, material, isCopy, made);
        };
    };
    juce::PopupMenu menu;
    menu.addSectionHeader(utf8(asked.name));
    menu.addItem("Name and colour" + dots(), ask(false));
    menu.addItem("Copy it for a new one" + dots(), ask(true));
    if (open) {
        menu.addItem("Frequency, decay and surface" + dots(), [open] { open(false); });
        menu.addItem("From a recording" + dots(), asked.frequencyHz > 0.0, false, [open] { open(true); });
    }
    menu.setLookAndFeel(&from.getLookAndFeel());
    const auto at = juce::PopupMenu::Options{}.withTargetComponent(from);
    menu.showMenuAsync(dynamic_cast<juce::Button*>(&from) != nullptr ? at : at.withMousePosition());
}

} // namespace physvib
