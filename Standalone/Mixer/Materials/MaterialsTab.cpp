// SPDX-License-Identifier: GPL-3.0-or-later
// Controls of the materials tab: list, frequency, decay, surface, test spot; a thread measures recordings.
#include "Mixer/Materials/MaterialsTab.h"
#include "Live/Recordings/ReadRecording.h"
#include "Mixer/Widgets/Cards.h"
#include "Scene/SceneLimits.h"

namespace physvib {
namespace {

constexpr int rowPixels = 28, headPixels = 20;
constexpr int tallPixels = 300; // of the tab
constexpr double arrowRatio = 1.01;

constexpr double decibelsOfDecay = 60.0;

/// Columns in a row of the list of materials, and formatting of its numbers.
struct MaterialColumns {
    juce::Rectangle<int> dot, name, frequency, decay, length, sign;
    explicit MaterialColumns(juce::Rectangle<int> row) {
        row.reduce(10, 0);
        dot = row.removeFromLeft(22);
        sign = row.removeFromRight(40);
        const int number = std::min(92, row.getWidth() * 22 / 100);
        length = row.removeFromRight(number);
        decay = row.removeFromRight(number);
        frequency = row.removeFromRight(number);
        name = row;
    }
};

juce::String frequencyText(double hz) { return number(hz, 1); }
juce::String decayText(double perSecond) { return number(perSecond, 2); }

} // namespace

/// Measures one recording on its own thread.
class MaterialsTab::Measuring final : public juce::Thread {
public:
    Measuring(Job wanted, juce::AsyncUpdater& isDone)
        : juce::Thread{"physvib material"}
        , job{std::move(wanted)}
        , isDone_{isDone} {
        startThread();
    }
    ~Measuring() override { stopThread(-1); }
    void run() override {
        hit = measureHit(pathOf(job.file));
        isDone_.triggerAsyncUpdate();
    }

    const Job job;
    std::optional<Result<RecordedHit>> hit; ///< set when the thread has ended

private:
    juce::AsyncUpdater& isDone_;
};

bool MaterialsTab::RatioSlider::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    const bool isUp = key == KeyPress::upKey || key == KeyPress::rightKey,
               isDown = key == KeyPress::downKey || key == KeyPress::leftKey;
    if (!isUp && !isDown) return juce::Slider::keyPressed(key);
    setValue(isUp ? getValue() * arrowRatio : getValue() / arrowRatio, juce::sendNotificationSync);
    return true;
}

MaterialsTab::MaterialsTab(MixerModel& model, WorldView& world)
    : model_{model}
    , world_{world} {
    setTitle("Materials");
    list_.setTitle("List of materials");
    list_.setRowHeight(rowPixels);
    prepareSlider(frequency_, "Frequency", sceneLimits::minSoundHz, FrequencyAxis::lowHz,
                  FrequencyAxis::highHz, limits::maxFrequencyHz);
    prepareSlider(decay_, "Decay", sceneLimits::minSoundDecayPerSecond, 1.0, 500.0,
                  limits::maxDecayPerSecond);
    frequency_.textFromValueFunction = [this](double hz) {
        return frequency_.isEnabled() ? frequencyText(hz) + " Hz" : juce::String{"silent"};
    };
    decay_.textFromValueFunction = [this](double perSecond) {
        return decay_.isEnabled() ? decayText(perSecond) + " /s" : juce::String{"silent"};
    };
    onSlide(frequency_, [this](bool continuesEdit) { setSound(true, continuesEdit); });
    onSlide(decay_, [this](bool continuesEdit) { setSound(false, continuesEdit); });
    texture_.onChange = [this](const Texture& texture, const juce::String& what, bool continuesEdit) {
        const auto* material = chosen();
        if (material == nullptr) return;
        const TextureAction surface{chosenIndex(), texture.grainMetres, texture.roughness, texture.pattern,
                                    texture.rolling};
        model_.reportFault(model_.world().edit(what + " of " + utf8(material->name), surface, continuesEdit));
    };
    for (auto* slider : {&spotX_, &spotY_}) {
        slider->setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
        slider->setSliderStyle(juce::Slider::LinearBar);
        slider->setRange(0.0, 100.0, 1.0);
        slider->setTextValueSuffix(" %");
        slider->onValueChange = [this] {
            spot_ = {0.01 * spotX_.getValue(), 0.01 * spotY_.getValue()};
            showSpot();
        };
    }
    spotX_.setTitle("Spot from the left");
    spotY_.setTitle("Spot from below");
    describe(feel_, "Feel the material at the spot",
             "Plays one hit of the material at the cross in the world; a click in the world plays it there");
    feel_.onClick = [this] { feelAt(spot_); };
    new_ = quietButton("New" + dots(),
                       "A material of one's own: a copy of the chosen one, with a name and a colour",
                       [this] { askName(true); });
    browse_ = quietButton(
        juce::String::fromUTF8("Recording\xe2\x80\xa6"),
        "Measure frequency and decay from a recording of one hit; it can be dropped here as well");
    browse_->onClick = [this] { browse(); };
    addAll(*this, {&list_, &frequencyName_, &frequency_, &decayName_, &decay_, &texture_, &feel_, &spotXName_,
                   &spotX_, &spotYName_, &spotY_, new_.get(), browse_.get(), &spectrum_, &course_});
    showSpot();
    mixChanged();
}

MaterialsTab::~MaterialsTab() {
    measuring_.reset();
    cancelPendingUpdate();
    world_.onSpot = nullptr;
}

void MaterialsTab::prepareSlider(RatioSlider& slider, const juce::String& title, double least, double low,
                                 double high, double most) {
    slider.setTitle(title);
    slider.setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
    slider.setSliderStyle(juce::Slider::LinearBar);
    slider.setNormalisableRange(feltRange(least, low, high, most));
    slider.valueFromTextFunction = [](const juce::String& words) {
        return words.trim().replaceCharacter(',', '.').getDoubleValue();
    };
}

const Material* MaterialsTab::chosen() const {
    const int index = chosenIndex();
    return index < 0 ? nullptr : &nth(model_.world().scene().materials, index);
}

int MaterialsTab::chosenIndex() const {
    const int row = list_.getSelectedRow();
    return row >= 0 && row < static_cast<int>(order_.size()) ? nth(order_, row) : -1;
}

void MaterialsTab::choose(int material) {
    if (const auto at = std::ranges::find(order_, material); at != order_.end())
        list_.selectRow(static_cast<int>(at - order_.begin()));
}

const RecordedHit* MaterialsTab::recordingOf(int material) const {
    const auto found = recordings_.find(material);
    return found == recordings_.end() ? nullptr : &found->second;
}

void MaterialsTab::mixChanged() {
    const auto& materials = model_.world().scene().materials;
    if (scene_ != model_.mix().scene) {
        scene_ = model_.mix().scene;
        recordings_.clear();
        shown_.reset();
        order_.resize(materials.size());
        for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = static_cast<int>(i);
        std::stable_partition(order_.begin(), order_.end(),
                              [&](int i) { return nth(materials, i).frequencyHz > 0.0; });
        list_.updateContent();
        list_.selectRow(0);
    }
    list_.repaint();
    showChosen();
}

void MaterialsTab::showChosen() {
    const auto* material = chosen();
    const bool sounds = material != nullptr && material->frequencyHz > 0.0;
    for (auto* control : std::initializer_list<juce::Component*>{&frequency_, &decay_, &feel_, browse_.get()})
        control->setEnabled(sounds);
    if (sounds && !frequency_.isMouseButtonDown())
        frequency_.setValue(material->frequencyHz, juce::dontSendNotification);
    if (sounds && !decay_.isMouseButtonDown())
        decay_.setValue(material->decayPerSecond, juce::dontSendNotification);
    frequency_.updateText();
    decay_.updateText();
    texture_.show(material != nullptr ? std::optional{material->texture()} : std::nullopt);
    ShownHit shown;
    const auto* recording = recordingOf(chosenIndex());
    if (sounds)
        shown = {material->frequencyHz, material->decayPerSecond,
                 palette::material(model_.world().scene().materials, chosenIndex()), recording};
    if (shown == shown_) return;
    shown_ = shown;
    const auto course = recording ? recording->course
                        : sounds  ? courseOf(material->frequencyHz, material->decayPerSecond)
                                  : HitCourse{};
    spectrum_.show(shown, course);
    course_.show(shown, course);
    resized();
}

void MaterialsTab::setSound(bool isFrequency, bool continuesEdit) {
    const auto* material = chosen();
    if (material == nullptr || !(material->frequencyHz > 0.0)) return;
    SoundAction sound{chosenIndex(), material->frequencyHz, material->decayPerSecond};
    (isFrequency ? sound.frequencyHz : sound.decayPerSecond) =
        isFrequency ? frequency_.getValue() : decay_.getValue();
    const auto name = (isFrequency ? "Frequency of " : "Decay of ") + utf8(material->name);
    model_.reportFault(model_.world().edit(name, sound, continuesEdit));
}

void MaterialsTab::typeFrequency() {
    for (auto* child : frequency_.getChildren())
        if (auto* box = dynamic_cast<juce::Label*>(child); box != nullptr && frequency_.isEnabled())
            box->showEditor();
}

void MaterialsTab::feelAt(FieldShare spot) {
    spot_ = spot;
    showSpot();
    if (chosenIndex() < 0) return;
    model_.reportFault(model_.strikes().audition(chosenIndex(), spot.x, spot.y));
}

void MaterialsTab::showSpot() {
    spotX_.setValue(100.0 * spot_.x, juce::dontSendNotification);
    spotY_.setValue(100.0 * spot_.y, juce::dontSendNotification);
    if (isVisible()) world_.showSpot(spot_);
}

void MaterialsTab::visibilityChanged() {
    world_.showSpot(isVisible() ? std::optional{spot_} : std::nullopt);
    if (isVisible())
        world_.onSpot = [this](FieldShare at) { feelAt(at); };
    else
        world_.onSpot = nullptr;
}

void MaterialsTab::browse() {
    const auto folder = juce::SharedResourcePointer<UserFolder> {
        } -> place();
    juce::StringArray others;
    for (const auto ending : soundEndings) others.add(std::string{ending});
    askForFile(*this, {"A recording of one hit", ".wav", folder, false, {}, others},
               [this](const juce::File& file) { measure(file); });
}

void MaterialsTab::askName(bool isCopy) {
    if (chosen() != nullptr)
        askMaterial(*this, model_, chosenIndex(), isCopy, [this](int material) { choose(material); });
}

void MaterialsTab::measure(const juce::File& file) {
    const auto* material = chosen();
    if (material == nullptr || !(material->frequencyHz > 0.0))
        return model_.report("Choose a material that sounds, then drop the recording");
    waiting_.push_back({file, chosenIndex(), scene_});
    if (!isMeasuring()) measureNext();
}

void MaterialsTab::measureNext() {
    if (!waiting_.empty()) {
        measuring_.reset(new Measuring{waiting_.front(), *this});
        waiting_.pop_front();
    }
    resized();
    repaint();
}

void MaterialsTab::finishMeasuring() {
    while (isMeasuring()) handleAsyncUpdate();
}

void MaterialsTab::handleAsyncUpdate() {
    if (!isMeasuring()) return;
    measuring_->waitForThreadToExit(-1);
    const auto done = std::move(measuring_);
    measureNext();
    finish(done->job, *done->hit);
}

void MaterialsTab::finish(const Job& job, const Result<RecordedHit>& hit) {
    if (!hit) return model_.report(utf8(hit.error));
    if (job.scene != model_.mix().scene)
        return model_.report(job.file.getFileName() + ": another scene is played now; drop it again");
    const auto& sound = hit.value.sound;
    const auto name = utf8(nth(model_.world().scene().materials, job.material).name);
    if (const auto fault = model_.world().edit(
            "Recording of " + name, SoundAction{job.material, sound.frequencyHz, sound.decayPerSecond});
        !fault.empty())
        return model_.report(job.file.getFileName() + ": " + utf8(fault));
    recordings_.insert_or_assign(job.material, hit.value);
    shown_.reset();
    showChosen();
}

void MaterialsTab::setDropping(bool isDropping) {
    isDropping_ = isDropping;
    resized();
    repaint();
}

void MaterialsTab::fileDragMove(const juce::StringArray&, int x, int y) {
    if (const auto at = list_.getLocalPoint(this, juce::Point<int>{x, y});
        list_.getLocalBounds().contains(at))
        if (const int row = list_.getRowContainingPosition(at.x, at.y); row >= 0) list_.selectRow(row);
    setDropping(true);
}

void MaterialsTab::filesDropped(const juce::StringArray& files, int x, int y) {
    fileDragMove(files, x, y);
    setDropping(false);
    if (files.size() != 1)
        return model_.report("Expected one recording, found " + juce::String{files.size()} + " files");
    measure(juce::File{files[0]});
}

void MaterialsTab::paint(juce::Graphics& g) {
    const MaterialColumns at{headArea_.withWidth(list_.getVisibleRowWidth())};
    ink(g, *this, Shade::muted, text::small);
    g.drawText("Material", at.name, juce::Justification::centredLeft, false);
    g.drawText("f Hz", at.frequency, juce::Justification::centredRight, false);
    g.drawText(juce::String::charToString(0x03c4) + " 1/s", at.decay, juce::Justification::centredRight,
               false);
    g.drawText(juce::String::charToString(0x2212) + "60 dB in", at.length, juce::Justification::centredRight,
               false);
}

void MaterialsTab::paintOverChildren(juce::Graphics& g) {
    if (!isDropping_ && !isMeasuring()) return;
    const auto* material = chosen();
    const auto plots = spectrum_.getBounds().getUnion(course_.getBounds());
    g.setColour(shade(*this, Shade::panel).withAlpha(0.85f));
    g.fillRect(plots);
    g.setColour(shade(*this, Shade::accent));
    g.drawRoundedRectangle(plots.toFloat().reduced(1.0f), 5.0f, 2.0f);
    g.setFont(text::font(text::medium));
    const auto name = material ? utf8(material->name) : juce::String{};
    g.drawText(isMeasuring() ? juce::String::fromUTF8("Measuring\xe2\x80\xa6")
                             : "Drop it: the sound of " + name,
               plots, juce::Justification::centred, true);
}

void MaterialsTab::resized() {
    auto area = getLocalBounds();
    headArea_ = area.removeFromTop(headPixels);
    new_->setBounds(headArea_.withLeft(headArea_.getRight() - 44));
    const bool isTall = area.getHeight() >= tallPixels;
    const int line = isTall ? rowHeight : rowHeight - 4, between = isTall ? 6 : 4;
    // a low tab has plots only of a recording; rows of the list come first
    const bool hasPlots = isTall || isDropping_ || isMeasuring() || recordingOf(chosenIndex()) != nullptr;
    const int room = area.getHeight() - 3 * line - 4 * between, all = static_cast<int>(order_.size()),
              plots = hasPlots ? std::max(70, std::min({230, room * 52 / 100, room - 5 * rowPixels})) : 0;
    list_.setBounds(
        area.removeFromTop(std::clamp((room - plots) / rowPixels, 3, std::max(3, all)) * rowPixels));
    physvib::setVisible({&spectrum_, &course_}, hasPlots);
    area.removeFromTop(between);
    auto row = area.removeFromTop(line);
    const auto place = [&row](juce::Label& name, juce::Component& control, int nameWidth, int width) {
        auto both = row.removeFromLeft(width);
        name.setBounds(both.removeFromLeft(nameWidth));
        control.setBounds(both);
        row.removeFromLeft(gap);
    };
    const int half = (row.getWidth() - gap) / 2;
    place(frequencyName_, frequency_, 64, half + 12);
    place(decayName_, decay_, 42, row.getWidth());
    area.removeFromTop(between);
    texture_.setBounds(area.removeFromTop(line));
    area.removeFromTop(between);
    row = area.removeFromTop(line);
    feel_.setBounds(row.removeFromLeft(70));
    row.removeFromLeft(gap);
    browse_->setBounds(row.removeFromRight(84));
    row.removeFromRight(4);
    const int each = (row.getWidth() - gap) / 2;
    place(spotXName_, spotX_, 12, each);
    place(spotYName_, spotY_, 12, row.getWidth());
    area.removeFromTop(between);
    if (area.getHeight() >= 150) {
        spectrum_.setBounds(area.removeFromTop((area.getHeight() - 6) / 2));
        area.removeFromTop(6);
    } else {
        spectrum_.setBounds(area.removeFromLeft((area.getWidth() - 6) / 2));
        area.removeFromLeft(6);
    }
    course_.setBounds(area);
}

juce::String MaterialsTab::getNameForRow(int row) {
    if (row < 0 || row >= getNumRows()) return {};
    const auto& m = nth(model_.world().scene().materials, nth(order_, row));
    return utf8(m.name) + (m.frequencyHz > 0.0 ? ", " + frequencyText(m.frequencyHz) + " hertz, decays by " +
                                                     decayText(m.decayPerSecond) + " per second"
                                               : juce::String{", silent"});
}

void MaterialsTab::listBoxItemClicked(int, const juce::MouseEvent& e) {
    if (e.mods.isPopupMenu())
        return showMaterialMenu(*this, model_, chosenIndex(), [this](int material) { choose(material); }, {});
    const MaterialColumns at{e.eventComponent->getLocalBounds()};
    if (at.dot.contains(e.getPosition())) return askName(false);
    if (feel_.isEnabled() && at.sign.contains(e.getPosition())) feelAt(spot_);
}

void MaterialsTab::listBoxItemDoubleClicked(int, const juce::MouseEvent& e) {
    const MaterialColumns at{e.eventComponent->getLocalBounds()};
    at.name.contains(e.getPosition()) ? askName(false) : typeFrequency();
}

void MaterialsTab::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= getNumRows()) return;
    const int index = nth(order_, row);
    const auto& m = nth(model_.world().scene().materials, index);
    if (isSelected) drawChosenRow(g, *this, width, height);
    const MaterialColumns at{{width, height}};
    const bool sounds = m.frequencyHz > 0.0;
    g.setColour(
        palette::material(model_.world().scene().materials, index).withMultipliedAlpha(sounds ? 1.0f : 0.5f));
    g.fillEllipse(at.dot.withWidth(14).toFloat().withSizeKeepingCentre(12.0f, 12.0f));
    ink(g, *this, sounds ? Shade::text : Shade::muted, text::medium);
    g.drawText(utf8(m.name), at.name, juce::Justification::centredLeft, true);
    if (!sounds)
        return g.drawText("does not vibrate", at.frequency.getUnion(at.length),
                          juce::Justification::centredRight, true);
    g.drawText(frequencyText(m.frequencyHz), at.frequency, juce::Justification::centredRight, true);
    g.drawText(decayText(m.decayPerSecond), at.decay, juce::Justification::centredRight, true);
    g.drawText(number(1e3 * decibelsOfDecay / 20.0 * std::log(10.0) / m.decayPerSecond, 0) + " ms", at.length,
               juce::Justification::centredRight, true);
    juce::Path sign;
    sign.addTriangle(-4.0f, -5.5f, -4.0f, 5.5f, 5.5f, 0.0f);
    g.setColour(shade(*this, isSelected ? Shade::accent : Shade::muted));
    g.fillPath(sign,
               juce::AffineTransform::translation(at.sign.toFloat().getCentre().translated(6.0f, 0.0f)));
}

} // namespace physvib
