// SPDX-License-Identifier: GPL-3.0-or-later
// Lays out cards, finds the host that shows them, closes a card before its answer is used, draws QR codes,
// and asks for names and colours of materials.
#include "Mixer/Widgets/Cards.h"
#include "Io/Text/QrCode.h"
#include "Scene/SceneValidation.h"

namespace physvib {
namespace {

CardHost* findCardHost(juce::Component& opener) { return opener.findParentComponentOfClass<CardHost>(); }

using SafeComponent = juce::Component::SafePointer<juce::Component>;

/// Closes the card after the click of its button was handled, then calls `onClosed`.
void closeCardThen(const SafeComponent& opener, std::function<void()> onClosed) {
    if (opener == nullptr) return;
    callLater(*opener, [onClosed = std::move(onClosed)](juce::Component& component) {
        if (auto* host = findCardHost(component)) host->setCard(nullptr);
        if (onClosed) onClosed();
    });
}

constexpr int updatesPerSecond = 15;

} // namespace

void askForFile(juce::Component& opener, const FileCard::Choice& choice,
                std::function<void(const juce::File&)> onAccept, std::function<void()> onCancelled) {
    askForFiles(
        opener, choice,
        [onAccept = std::move(onAccept)](const juce::Array<juce::File>& files) { onAccept(files[0]); },
        std::move(onCancelled));
}

void askForFiles(juce::Component& opener, const FileCard::Choice& choice,
                 const std::function<void(const juce::Array<juce::File>&)>& onAccept,
                 std::function<void()> onCancelled) {
    auto* host = findCardHost(opener);
    if (host == nullptr) return;
    auto card = std::make_unique<FileCard>(choice);
    card->onCancel = [safe = SafeComponent{&opener}, onCancelled = std::move(onCancelled)] {
        closeCardThen(safe, onCancelled);
    };
    card->onFiles = [safe = SafeComponent{&opener}, onAccept](const juce::Array<juce::File>& files) {
        closeCardThen(safe, [onAccept, files] { onAccept(files); });
    };
    host->setCard(std::move(card));
}

void askForValues(juce::Component& opener, const juce::String& title, const juce::String& acceptLabel,
                  const std::vector<QuestionCard::Field>& fields,
                  std::function<void(const juce::StringArray&)> onAccept, const juce::String& message) {
    auto* host = findCardHost(opener);
    if (host == nullptr) return;
    const auto card = std::make_shared<juce::Component::SafePointer<QuestionCard>>();
    const auto accept = [safe = SafeComponent{&opener}, card, fields, onAccept = std::move(onAccept)] {
        juce::StringArray values;
        for (const auto& field : fields) values.add((*card)->value(field.title));
        closeCardThen(safe, [onAccept, values] { onAccept(values); });
    };
    std::vector<QuestionCard::Answer> answers{{acceptLabel, accept},
                                              {"Cancel",
                                               [safe = SafeComponent{&opener}] { closeCardThen(safe, {}); },
                                               true, juce::KeyPress{juce::KeyPress::escapeKey}}};
    auto question = std::make_unique<QuestionCard>(title, message, std::move(answers), fields);
    *card = question.get();
    host->setCard(std::move(question));
}

juce::Image qrPicture(const std::string& link) {
    constexpr int maxSide = maxPictureSize; // the longest has 177 modules
    QrCode code{link};
    if (code.side() == 0) return {};
    const int modules = code.side() + 2 * QrCode::quietModules, cellPixels = std::min(6, maxSide / modules);
    juce::Image picture{juce::Image::RGB, modules * cellPixels, modules * cellPixels, false};
    juce::Graphics g{picture};
    g.fillAll(juce::Colours::white);
    g.setColour(juce::Colours::black);
    for (int y = 0; y < code.side(); ++y)
        for (int x = 0; x < code.side(); ++x)
            if (code.isDark(x, y))
                g.fillRect((x + QrCode::quietModules) * cellPixels, (y + QrCode::quietModules) * cellPixels,
                           cellPixels, cellPixels);
    return picture;
}

Card::Card(int width)
    : width_{width} {
    setWantsKeyboardFocus(true);
    title_.setFont(text::font(text::large, juce::Font::bold));
    messageLabel_.setFont(text::font(text::medium));
    messageLabel_.setJustificationType(juce::Justification::topLeft);
    messageLabel_.setMinimumHorizontalScale(1.0f); // the text has space for all lines
    for (auto* label : {&title_, &messageLabel_}) {
        label->setBorderSize({0, 0, 0, 0}); // aligned with the fields
        addAndMakeVisible(label);
    }
}

void Card::setTexts(const juce::String& title, const juce::String& text) {
    setTitle(title);
    setDescription(text);
    title_.setText(title, dontNotify);
    messageLabel_.setText(text, dontNotify);
}

void Card::setAnswers(std::vector<juce::TextButton*> answers) {
    for (auto* button : answers_) button->setVisible(false);
    answers_ = std::move(answers);
    for (auto* button : answers_) {
        if (button->getTitle().isEmpty()) button->setTitle(button->getButtonText());
        button->setToggleState(button == answers_.front() && button->isEnabled(), dontNotify);
        addAndMakeVisible(button);
    }
}

void Card::fitToContents() {
    prepareControls(*this);
    const auto middle = getBounds().getCentre();
    const int messageHeight =
        message().isEmpty()
            ? 0
            : 18 + text::heightInLines(messageLabel_.getFont(), message(), width_ - 2 * marginX - 4);
    const int height = 2 * marginY + titleHeight + messageHeight + contentHeight() + gap + answersHeight();
    const auto picture = pictureArea();
    setSize(width_ + (picture.x > 0 ? marginX + picture.x : 0), std::max(height, picture.y + 2 * marginY));
    setCentrePosition(middle);
    resized();
    repaint();
}

void Card::resized() {
    // a picture is to the left of this area; the first answer is at the card's right edge
    auto area = getLocalBounds().reduced(marginX, marginY);
    area = area.withLeft(area.getRight() - (width_ - 2 * marginX));
    title_.setBounds(area.removeFromTop(titleHeight));
    const int width = (area.getWidth() - (answersPerRow() - 1) * gap) / answersPerRow();
    const auto rows = area.removeFromBottom(answersHeight());
    for (int k = 0; k < static_cast<int>(answers_.size()); ++k)
        nth(answers_, k)
            ->setBounds(rows.getRight() - width - k % answersPerRow() * (width + gap),
                        rows.getY() + k / answersPerRow() * (cardRowHeight + gap), width, cardRowHeight);
    area.removeFromBottom(gap);
    placeContent(area.removeFromBottom(contentHeight()));
    messageLabel_.setBounds(area.withTrimmedTop(4));
}

FileCard::FileCard(const Choice& choice)
    : Card{cardWidth}
    , choice_{choice} {
    setTexts(choice.title, {});
    folderLabel_.setTitle("Folder");
    errorLabel_.setTitle("What is wrong");
    list_.setTitle("Files of the folder");
    list_.setRowHeight(rowHeight);
    list_.setMultipleSelectionEnabled(choice.allowsMultiple);
    name_.setTitle("Name of the file");
    name_.setFont(text::font(text::medium));
    name_.setText(choice.name, false);
    name_.setSelectAllWhenFocused(true);
    name_.setTextToShowWhenEmpty("name or path", juce::Colours::grey);
    name_.onReturnKey = [this] { accept(); };
    name_.onEscapeKey = [this] { onCancel(); };
    name_.onTextChange = [this] {
        fileToReplace_ = juce::File{};
        accept_.setButtonText(acceptLabel());
        showNote({}, Shade::text);
    };
    up_.setTitle("Parent folder");
    up_.onClick = [this] { openFolder(folder_.getParentDirectory()); };
    accept_.setButtonText(acceptLabel());
    accept_.onClick = [this] { accept(); };
    cancel_.onClick = [this] { onCancel(); };
    addAll(*this, {&folderLabel_, &up_, &list_, &name_, &errorLabel_});
    setAnswers({&accept_, &cancel_});
    openFolder(choice.folder);
}

bool FileCard::hasExtension(const juce::File& file) const {
    return !isFolder() && (file.hasFileExtension(choice_.extension) ||
                           std::ranges::any_of(choice_.otherExtensions, [&](const juce::String& extension) {
                               return file.hasFileExtension(extension);
                           }));
}

void FileCard::openFolder(const juce::File& folder) {
    folder_ = folder.isDirectory() ? folder : juce::File::getSpecialLocation(juce::File::userHomeDirectory);
    entries_ = folder_.findChildFiles(juce::File::findDirectories | juce::File::ignoreHiddenFiles, false);
    entries_.sort();
    auto files = folder_.findChildFiles(juce::File::findFiles | juce::File::ignoreHiddenFiles, false);
    files.sort();
    for (const auto& file : files)
        if (hasExtension(file)) entries_.add(file);
    folderLabel_.setText(folder_.getFullPathName(), dontNotify);
    list_.deselectAllRows();
    list_.updateContent();
    list_.repaint();
    showNote(!entries_.isEmpty() ? juce::String{}
             : isFolder()        ? juce::String{"No folders here"}
                                 : "No folders or " + choice_.extension + " files here",
             Shade::muted);
    rowCount_ = std::max(rowCount_, std::clamp(entries_.size(), minRows, maxRows));
    fitToContents();
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
        return openFolder(entries_[row]);
    if (name().isEmpty()) return isFolder() ? onFiles({folder_}) : showNote("Expected a name", Shade::limit);
    const auto target = folder_.getChildFile(name()); // or an absolute path
    if (target.isDirectory()) return openFolder(target);
    if (isFolder())
        return showNote(target.getFullPathName() + ": expected a folder that is there", Shade::limit);
    const auto file =
        hasExtension(target) ? target : target.getSiblingFile(target.getFileName() + choice_.extension);
    if (!choice_.isSaving)
        return file.existsAsFile()
                   ? onFiles({file})
                   : showNote(file.getFileName() + ": expected a file that is there", Shade::limit);
    if (!file.getParentDirectory().isDirectory())
        return showNote(file.getParentDirectory().getFullPathName() + ": expected a folder that is there",
                        Shade::limit);
    if (file.existsAsFile() && file != fileToReplace_) {
        fileToReplace_ = file;
        accept_.setButtonText("Replace");
        return showNote(file.getFileName() + " exists. Press again to replace it", Shade::highlight);
    }
    onFiles({file});
}

void FileCard::showNote(const juce::String& note, Shade tone) {
    errorLabel_.setText(note, dontNotify);
    errorLabel_.setTone(tone);
}

bool FileCard::keyPressed(const juce::KeyPress& key) {
    if (key == juce::KeyPress::escapeKey) return onCancel(), true;
    if (key == juce::KeyPress::returnKey) return accept(), true;
    if (key == juce::KeyPress::backspaceKey) return openFolder(folder_.getParentDirectory()), true;
    return false;
}

void FileCard::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= entries_.size()) return;
    auto area = juce::Rectangle<int>{width, height};
    if (isSelected) drawSelectedRow(g, *this, width, height, 0.22f);
    const auto& entry = entries_[row];
    const bool isFolder = entry.isDirectory();
    area.reduce(12, 0);
    setInk(g, *this, Shade::muted, text::small);
    g.drawText(isFolder ? juce::String{"folder"}
                        : entry.getLastModificationTime().formatted("%Y-%m-%d %H:%M"),
               area.removeFromRight(120), juce::Justification::centredRight, true);
    setInk(g, *this, Shade::text, text::medium, isFolder ? juce::Font::bold : juce::Font::plain);
    g.drawText(entry.getFileName(), area, juce::Justification::centredLeft, true);
}

void FileCard::placeContent(juce::Rectangle<int> area) {
    auto row = area.removeFromTop(rowHeight);
    up_.setBounds(row.removeFromRight(70));
    folderLabel_.setBounds(row.withTrimmedRight(gap));
    errorLabel_.setBounds(area.removeFromBottom(rowHeight));
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
            if (!dots.empty()) item.image = makeSwatch(nth(dots, k));
            list.getRootMenu()->addItem(std::move(item));
        }
        list.setText(field.value, dontNotify);
        addAndMakeVisible(control());
    }
    juce::Component& control() { return list.getNumItems() > 0 ? static_cast<juce::Component&>(list) : text; }
    juce::String value() const { return list.getNumItems() > 0 ? list.getText() : text.getText().trim(); }
    void paint(juce::Graphics& g) override {
        setInk(g, *this, Shade::muted, physvib::text::small);
        g.drawText(name, getLocalBounds().withWidth(nameWidth), juce::Justification::centredLeft, true);
    }
    void paintOverChildren(juce::Graphics& g) override {
        if (const int k = list.getSelectedItemIndex(); k >= 0 && k < static_cast<int>(dots.size()))
            makeSwatch(nth(dots, k))
                ->drawAt(g, static_cast<float>(getWidth()) - 56.0f,
                         0.5f * static_cast<float>(getHeight() - dotPixels), 1.0f);
    }
    void resized() override { control().setBounds(getLocalBounds().withTrimmedLeft(nameWidth)); }

    static constexpr int nameWidth = 130, dotPixels = 16;
    static std::unique_ptr<juce::Drawable> makeSwatch(juce::Colour colour) {
        auto picture = std::make_unique<juce::DrawablePath>();
        juce::Path circle;
        circle.addEllipse(0.0f, 0.0f, dotPixels, dotPixels);
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

QuestionCard::QuestionCard(const juce::String& title, const juce::String& message,
                           std::vector<Answer> answers, const std::vector<Field>& fields)
    : Card{cardWidth}
    , answers_{std::move(answers)} {
    setTexts(title, message);
    std::vector<juce::TextButton*> buttons;
    if (!answers_.front().key.isValid()) answers_.front().key = juce::KeyPress{juce::KeyPress::returnKey};
    for (std::size_t k = 0; k < answers_.size(); ++k) {
        const Answer& answer = answers_[k];
        auto& button = *buttons_.emplace_back(std::make_unique<juce::TextButton>(answer.label));
        if (answer.key.isValid())
            button.setTooltip(answer.label + " (" + answer.key.getTextDescription() + ")");
        button.setEnabled(answer.isEnabled);
        button.onClick = [this, k] { choose(k); };
        buttons.push_back(&button);
    }
    setAnswers(std::move(buttons));
    for (const Field& field : fields) {
        auto& newInput = *inputs_.emplace_back(std::make_unique<Input>(field));
        addAndMakeVisible(newInput);
        if (field.onChange)
            newInput.list.onChange = newInput.text.onTextChange =
                [this, &newInput, onChange = field.onChange] { onChange(*this, newInput.value()); };
        newInput.text.onReturnKey = [this] { keyPressed(juce::KeyPress{juce::KeyPress::returnKey}); };
        newInput.text.onEscapeKey = [this] { keyPressed(juce::KeyPress{juce::KeyPress::escapeKey}); };
    }
    fitToContents();
}

void QuestionCard::setPicture(const juce::Image& picture, const juce::String& placeholder) {
    picture_ = picture;
    placeholder_ = placeholder;
    fitToContents();
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
            input->list.setText(value, dontNotify);
        }
}

void QuestionCard::enableAnswer(const juce::String& answer, bool isEnabled) {
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (answers_[k].label == answer) buttons_[k]->setEnabled(answers_[k].isEnabled = isEnabled);
}

void QuestionCard::answer(const juce::String& label) {
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (answers_[k].label == label) return choose(k);
}

// Asynchronous, because the button's click is still being handled and the action may destroy the card.
void QuestionCard::choose(std::size_t index) {
    if (!answers_[index].isEnabled) return;
    callLater(*this, [index](QuestionCard& card) {
        const auto onAnswer = card.answers_[index].onAnswer;
        onAnswer();
    });
}

bool QuestionCard::keyPressed(const juce::KeyPress& key) {
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (buttons_[k]->hasKeyboardFocus(false) && key == juce::KeyPress::returnKey) return choose(k), true;
    for (std::size_t k = 0; k < answers_.size(); ++k)
        if (key == answers_[k].key) return choose(k), true;
    return false;
}

void QuestionCard::paint(juce::Graphics& g) {
    Card::paint(g);
    g.setImageResamplingQuality(juce::Graphics::lowResamplingQuality); // sharp on finer screens
    const auto room = juce::Rectangle<int>{marginX, marginY, pictureArea().x, pictureArea().y};
    const auto place = picture_.getBounds().withCentre(room.getCentre());
    if (picture_.isValid()) return g.drawImageAt(picture_, place.getX(), place.getY());
    setInk(g, *this, Shade::muted, text::medium);
    g.drawFittedText(placeholder_, room, juce::Justification::centred, 4, 1.0f);
}

void QuestionCard::placeContent(juce::Rectangle<int> content) {
    for (auto& input : inputs_) {
        input->setBounds(content.removeFromTop(rowHeight));
        content.removeFromTop(gap);
    }
}

RenderTask::RenderTask(const juce::File& file, Work work, OnDone onDone)
    : juce::Thread{"PhysVib render"}
    , file_{file}
    , work_{std::move(work)}
    , onDone_{std::move(onDone)} {
    juce::Component::setTitle("Progress");
    cancel_.setTitle("Cancel the making of the file");
    cancel_.onClick = [this] {
        cancel_.setEnabled(false);
        signalThreadShouldExit();
    };
    addAndMakeVisible(cancel_);
    prepareControls(*this);
    setSize(cardWidth, cardHeight);
    startThread();
    startTimerHz(updatesPerSecond);
}

RenderTask::~RenderTask() {
    constexpr int noTimeoutMs = -1;
    stopThread(noTimeoutMs);
}

void RenderTask::run() {
    error_ = work_([this](double share) {
        progressShare_ = share;
        return !threadShouldExit();
    });
}

void RenderTask::timerCallback() {
    repaint();
    if (isThreadRunning()) return;
    stopTimer();
    const auto onDone = onDone_; // which may destroy this object and its error
    const auto error = error_;
    onDone(error, error == "cancelled"); // it may have been finished or have failed when that was asked for
}

void RenderTask::paint(juce::Graphics& g) {
    drawCard(g, *this);
    auto area = getLocalBounds().reduced(12, 8).withTrimmedRight(92);
    setInk(g, *this, Shade::text, text::medium);
    const double share = juce::jlimit(0.0, 1.0, progressShare_.load());
    g.drawText(file_.getFileName() + "  " + juce::String{juce::roundToInt(100.0 * share)} + " %",
               area.removeFromTop(24), juce::Justification::centredLeft, true);
    const auto bar = area.removeFromBottom(8).toFloat();
    fillRound(g, *this, Shade::line, bar, 4.0f);
    fillRound(g, *this, Shade::accent, bar.withWidth(bar.getWidth() * static_cast<float>(share)), 4.0f);
}

void askMaterial(juce::Component& opener, MixerModel& model, int material, bool isCopy,
                 std::function<void(int material)> onDone) {
    static const juce::StringArray colours{"by its place", "red",  "amber", "light blue", "mauve",
                                           "tan",          "blue", "brown", "olive"};
    auto materials = model.world().drawing().drawn().materials;
    if (isCopy) materials.push_back(Material{nth(materials, material)});
    const auto index = isCopy ? materials.size() - 1 : static_cast<std::size_t>(material);
    const Material source = materials[index];
    std::vector<juce::Colour> dots;
    for (int k = 0; k < colours.size(); ++k) {
        materials[index].colour = k;
        dots.push_back(palette::material(materials, static_cast<int>(index)));
    }
    const auto name = utf8(source.name);
    askForValues(
        *opener.getParentComponent(), // a swatch itself is replaced when any material changes
        isCopy ? "A material of one's own" : "Name and colour", isCopy ? "Make it" : "Change",
        {{"Name", isCopy ? "own " + name : name}, {"Colour", colours[source.colour], {}, colours, {}, dots}},
        [&model, material, isCopy, onDone = std::move(onDone)](const juce::StringArray& values) {
            constexpr double startHz = 165.0, startDecay = 22.0; // for a copy of a silent material
            Scene scene = model.world().drawing().drawn();
            auto& sceneMaterials = scene.materials;
            const auto target = static_cast<std::size_t>(isCopy ? std::ssize(sceneMaterials) : material);
            if (isCopy) sceneMaterials.push_back(Material{nth(sceneMaterials, material)});
            Material& editedMaterial = sceneMaterials[target];
            if (isCopy && editedMaterial.frequencyHz <= 0.0)
                editedMaterial.frequencyHz = startHz, editedMaterial.decayPerSecond = startDecay;
            editedMaterial.name = values[0].toStdString(), editedMaterial.colour = colours.indexOf(values[1]);
            if (model.reportIfError(validate(scene))) return;
            model.change(isCopy ? "New material" : "Name and colour",
                         [&](Mix& mix) { mix.scene = std::make_shared<const Scene>(std::move(scene)); });
            model.dispatchPendingMessages();
            onDone(static_cast<int>(target));
        },
        isCopy
            ? "It begins as a copy of " + name +
                  ": set its frequency, decay and surface, or measure a recording. Bodies start where they "
                  "were drawn."
            : "Bodies start where they were drawn.");
}

void showMaterialMenu(juce::Component& opener, MixerModel& model, int material,
                      std::function<void(int)> onDone, std::function<void(bool isRecording)> openPage) {
    const auto& materials = model.world().drawing().drawn().materials;
    if (material < 0 || material >= static_cast<int>(materials.size())) return;
    const Material& source = nth(materials, material);
    const auto ask = [safe = SafeComponent{&opener}, &model, material,
                      onDone = std::move(onDone)](bool isCopy) {
        return [safe, &model, material, onDone, isCopy] {
            if (safe != nullptr) askMaterial(*safe, model, material, isCopy, onDone);
        };
    };
    juce::PopupMenu menu;
    menu.addSectionHeader(utf8(source.name));
    menu.addItem("Name and colour" + ellipsis(), ask(false));
    menu.addItem("Copy it for a new one" + ellipsis(), ask(true));
    if (openPage) {
        menu.addItem("Frequency, decay and surface" + ellipsis(), [openPage] { openPage(false); });
        menu.addItem("From a recording" + ellipsis(), source.frequencyHz > 0.0, false,
                     [openPage] { openPage(true); });
    }
    menu.setLookAndFeel(&opener.getLookAndFeel());
    const auto options = juce::PopupMenu::Options{}.withTargetComponent(opener);
    menu.showMenuAsync(dynamic_cast<juce::Button*>(&opener) != nullptr ? options
                                                                       : options.withMousePosition());
}

} // namespace physvib
