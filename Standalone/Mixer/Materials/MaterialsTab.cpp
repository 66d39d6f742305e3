// SPDX-License-Identifier: GPL-3.0-or-later
// The materials tab: its controls, its list of materials, and the thread that measures recordings.
#include "Mixer/Materials/MaterialsTab.h"
#include "Live/Recordings/ReadRecording.h"
#include "Mixer/Widgets/Cards.h"
#include "Scene/SceneLimits.h"

namespace physvib {
namespace {

constexpr int rowPixels = 28, headerPixels = 20, plotSpacing = 6, minStackedHeight = 150;
constexpr int minTallHeight = 300;      // of the tab in pixels; a lower one has narrower rows
constexpr double arrowKeyFactor = 1.01; // of the value before and after an arrow key

constexpr double decayDecibels = 60.0; // by which a hit has decayed after the duration in the list

/// Areas of the columns in a row of the list of materials.
struct MaterialColumns {
    juce::Rectangle<int> colourDot, name, frequency, decay, length, playSign;
    explicit MaterialColumns(juce::Rectangle<int> row) {
        row.reduce(10, 0);
        colourDot = row.removeFromLeft(22);
        playSign = row.removeFromRight(40);
        const int numberWidth = std::min(92, row.getWidth() * 22 / 100);
        length = row.removeFromRight(numberWidth);
        decay = row.removeFromRight(numberWidth);
        frequency = row.removeFromRight(numberWidth);
        name = row;
    }
};

juce::String frequencyText(double hz) { return number(hz, 1); }
juce::String decayText(double perSecond) { return number(perSecond, 2); }

} // namespace

/// Measures one recording on its own thread.
class MaterialsTab::MeasuringThread final : public juce::Thread {
public:
    MeasuringThread(Job newJob, juce::AsyncUpdater& updater)
        : juce::Thread{"physvib material"}
        , job{std::move(newJob)}
        , updater_{updater} {
        startThread();
    }
    ~MeasuringThread() override { stopThread(-1); }
    void run() override {
        hit = measureHit(pathOf(job.file));
        updater_.triggerAsyncUpdate();
    }

    const Job job;
    std::optional<Result<RecordedHit>> hit; ///< set when the thread has ended

private:
    juce::AsyncUpdater& updater_;
};

bool MaterialsTab::RatioSlider::keyPressed(const juce::KeyPress& key) {
    using juce::KeyPress;
    const bool isUp = key == KeyPress::upKey || key == KeyPress::rightKey,
               isDown = key == KeyPress::downKey || key == KeyPress::leftKey;
    if (!isUp && !isDown) return juce::Slider::keyPressed(key);
    setValue(isUp ? getValue() * arrowKeyFactor : getValue() / arrowKeyFactor, juce::sendNotificationSync);
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
    onSliderChange(frequency_, [this](bool continuesEdit) { setSound(true, continuesEdit); });
    onSliderChange(decay_, [this](bool continuesEdit) { setSound(false, continuesEdit); });
    texture_.onChange = [this](const Texture& texture, const juce::String& valueName, bool continuesEdit) {
        const auto* material = selected();
        if (material == nullptr) return;
        const TextureAction surface{selectedIndex(), texture.grainMetres, texture.roughness, texture.pattern,
                                    texture.rolling};
        model_.reportIfError(
            model_.world().edit(valueName + " of " + utf8(material->name), surface, continuesEdit));
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
    describe(playButton_, "Feel the material at the spot",
             "Plays one hit of the material at the cross in the world; a click in the world plays it there");
    playButton_.onClick = [this] { playAt(spot_); };
    newButton_ = makeLinkButton("New" + ellipsis(),
                                "A material of one's own: a copy of the chosen one, with a name and a colour",
                                [this] { showMaterialEditor(true); });
    browseButton_ = makeLinkButton(
        juce::String::fromUTF8("Recording\xe2\x80\xa6"),
        "Measure frequency and decay from a recording of one hit; it can be dropped here as well");
    browseButton_->onClick = [this] { browse(); };
    addAll(*this, {&list_, &frequencyLabel_, &frequency_, &decayLabel_, &decay_, &texture_, &playButton_,
                   &spotXLabel_, &spotX_, &spotYLabel_, &spotY_, newButton_.get(), browseButton_.get(),
                   &spectrum_, &waveform_});
    showSpot();
    mixChanged();
}

MaterialsTab::~MaterialsTab() {
    measuringThread_.reset();
    cancelPendingUpdate();
    world_.onSpot = nullptr;
}

void MaterialsTab::prepareSlider(RatioSlider& slider, const juce::String& title, double minValue, double low,
                                 double high, double maxValue) {
    slider.setTitle(title);
    slider.setColour(juce::Slider::textBoxOutlineColourId, juce::Colours::transparentBlack);
    slider.setSliderStyle(juce::Slider::LinearBar);
    slider.setNormalisableRange(perceptualRange(minValue, low, high, maxValue));
}

const Material* MaterialsTab::selected() const {
    const int index = selectedIndex();
    return index < 0 ? nullptr : &nth(model_.world().scene().materials, index);
}

int MaterialsTab::selectedIndex() const {
    const int row = list_.getSelectedRow();
    return row >= 0 && row < static_cast<int>(rowMaterials_.size()) ? nth(rowMaterials_, row) : -1;
}

void MaterialsTab::choose(int material) {
    if (const auto entry = std::ranges::find(rowMaterials_, material); entry != rowMaterials_.end())
        list_.selectRow(static_cast<int>(entry - rowMaterials_.begin()));
}

const RecordedHit* MaterialsTab::findRecording(int material) const {
    const auto entry = recordings_.find(material);
    return entry == recordings_.end() ? nullptr : &entry->second;
}

void MaterialsTab::mixChanged() {
    const auto& materials = model_.world().scene().materials;
    if (scene_ != model_.mix().scene) {
        scene_ = model_.mix().scene;
        recordings_.clear();
        plottedHit_.reset();
        rowMaterials_.resize(materials.size());
        for (std::size_t i = 0; i < rowMaterials_.size(); ++i) rowMaterials_[i] = static_cast<int>(i);
        std::stable_partition(rowMaterials_.begin(), rowMaterials_.end(),
                              [&](int i) { return nth(materials, i).frequencyHz > 0.0; });
        list_.updateContent();
        list_.selectRow(0);
    }
    list_.repaint();
    showSelected();
}

void MaterialsTab::showSelected() {
    const auto* material = selected();
    const bool vibrates = material != nullptr && material->frequencyHz > 0.0;
    for (auto* control :
         std::initializer_list<juce::Component*>{&frequency_, &decay_, &playButton_, browseButton_.get()})
        control->setEnabled(vibrates);
    if (vibrates && !frequency_.isMouseButtonDown())
        frequency_.setValue(material->frequencyHz, juce::dontSendNotification);
    if (vibrates && !decay_.isMouseButtonDown())
        decay_.setValue(material->decayPerSecond, juce::dontSendNotification);
    frequency_.updateText();
    decay_.updateText();
    texture_.show(material != nullptr ? std::optional{material->texture()} : std::nullopt);
    PlottedHit newHit;
    const auto* recording = findRecording(selectedIndex());
    if (vibrates)
        newHit = {material->frequencyHz, material->decayPerSecond,
                  palette::material(model_.world().scene().materials, selectedIndex()), recording};
    if (newHit == plottedHit_) return;
    plottedHit_ = newHit;
    const auto waveform = recording  ? recording->waveform
                          : vibrates ? makeModeWaveform(material->frequencyHz, material->decayPerSecond)
                                     : HitWaveform{};
    spectrum_.show(newHit, waveform);
    waveform_.show(newHit, waveform);
    resized();
}

void MaterialsTab::setSound(bool isFrequency, bool continuesEdit) {
    const auto* material = selected();
    if (material == nullptr || !(material->frequencyHz > 0.0)) return;
    SoundAction sound{selectedIndex(), material->frequencyHz, material->decayPerSecond};
    (isFrequency ? sound.frequencyHz : sound.decayPerSecond) =
        isFrequency ? frequency_.getValue() : decay_.getValue();
    const auto name = (isFrequency ? "Frequency of " : "Decay of ") + utf8(material->name);
    model_.reportIfError(model_.world().edit(name, sound, continuesEdit));
}

void MaterialsTab::editFrequency() {
    for (auto* child : frequency_.getChildren())
        if (auto* textBox = dynamic_cast<juce::Label*>(child); textBox != nullptr && frequency_.isEnabled())
            textBox->showEditor();
}

void MaterialsTab::playAt(FieldShare spot) {
    spot_ = spot;
    showSpot();
    if (selectedIndex() < 0) return;
    model_.reportIfError(model_.eventPlayer().audition(selectedIndex(), spot.x, spot.y));
}

void MaterialsTab::showSpot() {
    spotX_.setValue(100.0 * spot_.x, juce::dontSendNotification);
    spotY_.setValue(100.0 * spot_.y, juce::dontSendNotification);
    if (isVisible()) world_.showSpot(spot_);
}

void MaterialsTab::visibilityChanged() {
    world_.showSpot(isVisible() ? std::optional{spot_} : std::nullopt);
    if (isVisible())
        world_.onSpot = [this](FieldShare spot) { playAt(spot); };
    else
        world_.onSpot = nullptr;
}

void MaterialsTab::browse() {
    const auto folder = juce::SharedResourcePointer<UserFolder> {
        } -> location();
    juce::StringArray extensions;
    for (const auto ending : soundFileExtensions) extensions.add(std::string{ending});
    askForFile(*this, {"A recording of one hit", ".wav", folder, false, {}, extensions},
               [this](const juce::File& file) { measure(file); });
}

void MaterialsTab::showMaterialEditor(bool isCopy) {
    if (selected() != nullptr)
        askMaterial(*this, model_, selectedIndex(), isCopy, [this](int material) { choose(material); });
}

void MaterialsTab::measure(const juce::File& file) {
    const auto* material = selected();
    if (material == nullptr || !(material->frequencyHz > 0.0))
        return model_.report("Choose a material that sounds, then drop the recording");
    pendingJobs_.push_back({file, selectedIndex(), scene_});
    if (!isMeasuring()) measureNext();
}

void MaterialsTab::measureNext() {
    if (!pendingJobs_.empty()) {
        measuringThread_.reset(new MeasuringThread{pendingJobs_.front(), *this});
        pendingJobs_.pop_front();
    }
    resized();
    repaint();
}

void MaterialsTab::finishMeasuring() {
    while (isMeasuring()) handleAsyncUpdate();
}

void MaterialsTab::handleAsyncUpdate() {
    if (!isMeasuring()) return;
    measuringThread_->waitForThreadToExit(-1);
    const auto finished = std::move(measuringThread_);
    measureNext();
    applyMeasurement(finished->job, *finished->hit);
}

void MaterialsTab::applyMeasurement(const Job& job, const Result<RecordedHit>& hit) {
    if (!hit) return model_.report(utf8(hit.error));
    if (job.scene != model_.mix().scene)
        return model_.report(job.file.getFileName() + ": another scene is played now; drop it again");
    const auto& sound = hit.value.sound;
    const auto name = utf8(nth(model_.world().scene().materials, job.material).name);
    if (const auto error = model_.world().edit(
            "Recording of " + name, SoundAction{job.material, sound.frequencyHz, sound.decayPerSecond});
        !error.empty())
        return model_.report(job.file.getFileName() + ": " + utf8(error));
    recordings_.insert_or_assign(job.material, hit.value);
    plottedHit_.reset();
    showSelected();
}

void MaterialsTab::setDragOver(bool isDragOver) {
    isDragOver_ = isDragOver;
    resized();
    repaint();
}

void MaterialsTab::fileDragMove(const juce::StringArray&, int x, int y) {
    if (const auto point = list_.getLocalPoint(this, juce::Point<int>{x, y});
        list_.getLocalBounds().contains(point))
        if (const int row = list_.getRowContainingPosition(point.x, point.y); row >= 0) list_.selectRow(row);
    setDragOver(true);
}

void MaterialsTab::filesDropped(const juce::StringArray& files, int x, int y) {
    fileDragMove(files, x, y);
    setDragOver(false);
    if (files.size() != 1)
        return model_.report("Expected one recording, found " + juce::String{files.size()} + " files");
    measure(juce::File{files[0]});
}

void MaterialsTab::paint(juce::Graphics& g) {
    const MaterialColumns columns{listHeadArea_.withWidth(list_.getVisibleRowWidth())};
    setInk(g, *this, Shade::muted, text::small);
    g.drawText("Material", columns.name, juce::Justification::centredLeft, false);
    g.drawText("f Hz", columns.frequency, juce::Justification::centredRight, false);
    g.drawText(juce::String::charToString(0x03c4) + " 1/s", columns.decay, juce::Justification::centredRight,
               false);
    g.drawText(juce::String::charToString(0x2212) + "60 dB in", columns.length,
               juce::Justification::centredRight, false);
}

void MaterialsTab::paintOverChildren(juce::Graphics& g) {
    if (!isDragOver_ && !isMeasuring()) return;
    const auto* material = selected();
    const auto plotsArea = spectrum_.getBounds().getUnion(waveform_.getBounds());
    g.setColour(shade(*this, Shade::panel).withAlpha(0.85f));
    g.fillRect(plotsArea);
    g.setColour(shade(*this, Shade::accent));
    g.drawRoundedRectangle(plotsArea.toFloat().reduced(1.0f), 5.0f, 2.0f);
    g.setFont(text::font(text::medium));
    const auto name = material ? utf8(material->name) : juce::String{};
    g.drawText(isMeasuring() ? juce::String::fromUTF8("Measuring\xe2\x80\xa6")
                             : "Drop it: the sound of " + name,
               plotsArea, juce::Justification::centred, true);
}

void MaterialsTab::resized() {
    auto area = getLocalBounds();
    listHeadArea_ = area.removeFromTop(headerPixels);
    newButton_->setBounds(listHeadArea_.withLeft(listHeadArea_.getRight() - 44));
    const bool isTall = area.getHeight() >= minTallHeight;
    const int lineHeight = isTall ? rowHeight : rowHeight - 4, spacing = isTall ? 6 : 4;
    // a low tab has plots only of a recording, as the rows of the list come first
    const bool hasPlots = isTall || isDragOver_ || isMeasuring() || findRecording(selectedIndex()) != nullptr;
    const int height = area.getHeight() - 3 * lineHeight - 4 * spacing,
              rowCount = static_cast<int>(rowMaterials_.size()),
              plots = hasPlots ? std::max(70, std::min({230, height * 52 / 100, height - 5 * rowPixels})) : 0;
    list_.setBounds(
        area.removeFromTop(std::clamp((height - plots) / rowPixels, 3, std::max(3, rowCount)) * rowPixels));
    physvib::setVisible({&spectrum_, &waveform_}, hasPlots);
    area.removeFromTop(spacing);
    auto row = area.removeFromTop(lineHeight);
    const auto placeLabelled = [&row](juce::Label& name, juce::Component& control, int nameWidth, int width) {
        auto cell = row.removeFromLeft(width);
        name.setBounds(cell.removeFromLeft(nameWidth));
        control.setBounds(cell);
        row.removeFromLeft(gap);
    };
    const int halfWidth = (row.getWidth() - gap) / 2;
    placeLabelled(frequencyLabel_, frequency_, 64, halfWidth + 12);
    placeLabelled(decayLabel_, decay_, 42, row.getWidth());
    area.removeFromTop(spacing);
    texture_.setBounds(area.removeFromTop(lineHeight));
    area.removeFromTop(spacing);
    row = area.removeFromTop(lineHeight);
    playButton_.setBounds(row.removeFromLeft(70));
    row.removeFromLeft(gap);
    browseButton_->setBounds(row.removeFromRight(84));
    row.removeFromRight(4);
    const int spotWidth = (row.getWidth() - gap) / 2;
    placeLabelled(spotXLabel_, spotX_, 12, spotWidth);
    placeLabelled(spotYLabel_, spotY_, 12, row.getWidth());
    area.removeFromTop(spacing);
    if (area.getHeight() >= minStackedHeight) {
        spectrum_.setBounds(area.removeFromTop((area.getHeight() - plotSpacing) / 2));
        area.removeFromTop(plotSpacing);
    } else {
        spectrum_.setBounds(area.removeFromLeft((area.getWidth() - plotSpacing) / 2));
        area.removeFromLeft(plotSpacing);
    }
    waveform_.setBounds(area);
}

juce::String MaterialsTab::getNameForRow(int row) {
    if (row < 0 || row >= getNumRows()) return {};
    const auto& m = nth(model_.world().scene().materials, nth(rowMaterials_, row));
    return utf8(m.name) + (m.frequencyHz > 0.0 ? ", " + frequencyText(m.frequencyHz) + " hertz, decays by " +
                                                     decayText(m.decayPerSecond) + " per second"
                                               : juce::String{", silent"});
}

void MaterialsTab::listBoxItemClicked(int, const juce::MouseEvent& e) {
    if (e.mods.isPopupMenu())
        return showMaterialMenu(*this, model_, selectedIndex(), [this](int material) { choose(material); },
                                {});
    const MaterialColumns columns{e.eventComponent->getLocalBounds()};
    if (columns.colourDot.contains(e.getPosition())) return showMaterialEditor(false);
    if (playButton_.isEnabled() && columns.playSign.contains(e.getPosition())) playAt(spot_);
}

void MaterialsTab::listBoxItemDoubleClicked(int, const juce::MouseEvent& e) {
    const MaterialColumns columns{e.eventComponent->getLocalBounds()};
    columns.name.contains(e.getPosition()) ? showMaterialEditor(false) : editFrequency();
}

void MaterialsTab::paintListBoxItem(int row, juce::Graphics& g, int width, int height, bool isSelected) {
    if (row >= getNumRows()) return;
    const int index = nth(rowMaterials_, row);
    const auto& m = nth(model_.world().scene().materials, index);
    if (isSelected) drawSelectedRow(g, *this, width, height);
    const MaterialColumns columns{{width, height}};
    const bool vibrates = m.frequencyHz > 0.0;
    g.setColour(palette::material(model_.world().scene().materials, index)
                    .withMultipliedAlpha(vibrates ? 1.0f : 0.5f));
    g.fillEllipse(columns.colourDot.withWidth(14).toFloat().withSizeKeepingCentre(12.0f, 12.0f));
    setInk(g, *this, vibrates ? Shade::text : Shade::muted, text::medium);
    g.drawText(utf8(m.name), columns.name, juce::Justification::centredLeft, true);
    if (!vibrates)
        return g.drawText("does not vibrate", columns.frequency.getUnion(columns.length),
                          juce::Justification::centredRight, true);
    g.drawText(frequencyText(m.frequencyHz), columns.frequency, juce::Justification::centredRight, true);
    g.drawText(decayText(m.decayPerSecond), columns.decay, juce::Justification::centredRight, true);
    g.drawText(number(1e3 * decayDecibels / 20.0 * std::log(10.0) / m.decayPerSecond, 0) + " ms",
               columns.length, juce::Justification::centredRight, true);
    juce::Path playSign;
    playSign.addTriangle(-4.0f, -5.5f, -4.0f, 5.5f, 5.5f, 0.0f);
    g.setColour(shade(*this, isSelected ? Shade::accent : Shade::muted));
    g.fillPath(playSign, juce::AffineTransform::translation(
                             columns.playSign.toFloat().getCentre().translated(6.0f, 0.0f)));
}

} // namespace physvib
