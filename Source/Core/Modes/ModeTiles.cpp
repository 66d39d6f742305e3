// SPDX-License-Identifier: MIT
// Tile rendering with vector kernels: packing coefficient rows, rendering tiles, adding strikes.
#include "Core/Modes/ModeTiles.h"
#include "Core/Modes/TileKernels.h"
#include <cmath>

namespace physvib {
#if !PHYSVIB_HIGHWAY // TileKernels.cpp is not part of this build
const TileKernel* tileKernel(InstructionSet) noexcept { return nullptr; }
#endif

bool isAvailable(InstructionSet set) noexcept {
    return set == InstructionSet::best || set == InstructionSet::scalar || tileKernel(set) != nullptr;
}

InstructionSet ModeTiles::set() const noexcept { return isOn() ? kernel_->set : InstructionSet::scalar; }

bool ModeTiles::prepare(int channels, InstructionSet set, int maxSlots) noexcept {
    static const LowRankBasis basis;
    basis_ = &basis;
    kernel_ = tileKernel(set);
    channels_ = channels;
    slots_ = isOn() ? maxSlots : 0;
    floatsPerSlot_ =
        (channels + tiles::channelsPerLine - 1) / tiles::channelsPerLine * 4 * tiles::channelsPerLine;
    slotsInUse_ = 0;
    strikes_.count = 0;
    if (!allocate()) return false;
    for (std::size_t s = 0; s < index(slots_); ++s) slotRows_[s].isUsed = false;
    std::fill_n(amplitudes_.data(), slots_ * floatsPerSlot_, 0.0f);
    for (auto* values : {&re_, &im_, &stepRe_, &stepIm_})
        std::fill_n(values->data(), (slots_ + 7) / 8 * 8, 0.0);
    for (auto& layer : layers_) {
        std::fill_n(layer.tails.data(), isOn() ? channels_ * tiles::frames : 0, 0.0);
        layer.counts.fill(0);
        layer.hasBase = false;
        layer.tailsFrom = tiles::frames;
    }
    begin();
    return true;
}

bool ModeTiles::allocate() noexcept {
    const auto count = index(slots_), wide = (count + 7) / 8 * 8,
               tile = isOn() ? index(channels_) * frames : 0;
    bool hasMemory = scaledGains_.resize(isOn() ? 2 * index(channels_) * TileStrikes::maxCount : 0) &&
                     slotRows_.resize(count) && amplitudes_.resize(count * index(floatsPerSlot_)) &&
                     rows_.resize(count * rowFloats);
    for (auto* values : {&re_, &im_, &stepRe_, &stepIm_}) hasMemory = hasMemory && values->resize(wide);
    for (auto* values : {&roundedRe_, &roundedIm_}) hasMemory = hasMemory && values->resize(wide);
    for (auto& row : rowSlots_) hasMemory = hasMemory && row.resize(count);
    for (auto& layer : layers_) hasMemory = hasMemory && layer.base.resize(tile) && layer.tails.resize(tile);
    return hasMemory;
}

float* ModeTiles::rowAt(std::size_t rank, int row) noexcept {
    return rows_.data() + index(slots_) * rankOffsets[rank] + index(row) * 2 * index(tiles::ranks[rank]);
}

void ModeTiles::add(int slot, const TileMode& mode) noexcept {
    const int wanted = LowRankBasis::rankFor(mode.radiansPerFrame);
    const auto rank = index(
        static_cast<int>(std::find(tiles::ranks.begin(), tiles::ranks.end(), wanted) - tiles::ranks.begin()));
    const int row = rowFor(mode.isGated, layers_[mode.isGated].counts[rank]++);
    slotRows_[index(slot)] = {static_cast<int>(rank), row, mode, true};
    rowSlots_[rank][index(row)] = slot;
    basis_->project(mode.cosPowers, mode.sinPowers, wanted, rowAt(rank, row));
    stepRe_[index(slot)] = mode.tileFactor.re;
    stepIm_[index(slot)] = mode.tileFactor.im;
    slotsInUse_ = std::max(slotsInUse_, slot + 1);
}

// The layer's last row replaces the removed one.
void ModeTiles::remove(int slot) noexcept {
    SlotRow& slotRow = slotRows_[index(slot)];
    const auto rank = index(slotRow.rank);
    const int last = rowFor(slotRow.mode.isGated, --layers_[slotRow.mode.isGated].counts[rank]);
    if (last != slotRow.row) {
        std::copy_n(rowAt(rank, last), 2 * tiles::ranks[rank], rowAt(rank, slotRow.row));
        const int moved = rowSlots_[rank][index(last)];
        rowSlots_[rank][index(slotRow.row)] = moved;
        slotRows_[index(moved)].row = slotRow.row;
    }
    slotRow.isUsed = false;
    for (auto* values : {&re_, &im_, &stepRe_, &stepIm_}) (*values)[index(slot)] = 0.0;
    while (slotsInUse_ > 0 && !slotRows_[index(slotsInUse_ - 1)].isUsed) --slotsInUse_;
}

void ModeTiles::setCarrier(int slot, Complex<double> carrier) noexcept {
    const auto s = index(slot);
    re_[s] = carrier.re;
    im_[s] = carrier.im;
    roundedRe_[s] = static_cast<float>(carrier.re);
    roundedIm_[s] = static_cast<float>(carrier.im);
}

void ModeTiles::setAmplitudes(int slot, const Complex<double>* amplitudes) noexcept {
    // Whole cache lines: values behind the last channel are never summed.
    float* line = amplitudes_.data() + index(slot) * index(floatsPerSlot_);
    for (int j = 0; j < channels_; j += tiles::channelsPerLine, line += 16) {
        for (int k = 0; k < tiles::channelsPerLine; ++k) {
            line[2 * k] = static_cast<float>(amplitudes[j + k].re);
            line[2 * k + 1] = static_cast<float>(amplitudes[j + k].im);
        }
        for (int k = 0; k < tiles::channelsPerLine; ++k) {
            line[2 * k + 8] = -line[2 * k + 1];
            line[2 * k + 9] = line[2 * k];
        }
    }
}

void ModeTiles::advance() noexcept { kernel_->advance(carriers()); }

void ModeTiles::begin() noexcept {
    if (isEmpty()) return;
    invalidateFrom(false, 0);
    invalidateFrom(true, 0);
}

void ModeTiles::invalidateFrom(bool isGated, int frame) noexcept {
    layers_[isGated].staleFrom = std::min(layers_[isGated].staleFrom, frame);
}

void ModeTiles::settle() noexcept {
    if (std::min(layers_[0].staleFrom, layers_[1].staleFrom) == tiles::frames) return;
    finishStrikes(); // because the tile is rendered from the amplitudes after them
    if (layers_[0].staleFrom < tiles::frames) renderLayer(layers_[0], false);
    if (layers_[1].staleFrom < tiles::frames) renderLayer(layers_[1], true);
}

// Renders the layer's tile again; frames before `staleFrom` stay.
void ModeTiles::renderLayer(Layer& layer, bool isGated) noexcept {
    const auto from = index(layer.staleFrom);
    layer.staleFrom = tiles::frames;
    const auto clear = [&](auto& values, std::size_t first) {
        for (std::size_t j = 0; j < index(channels_); ++j)
            std::fill_n(values.data() + j * frames + first, frames - first, 0);
    };
    if (layer.hasTails()) clear(layer.tails, std::max(from, index(layer.tailsFrom)));
    if (from <= index(layer.tailsFrom)) layer.tailsFrom = tiles::frames;
    const bool hasModes = std::any_of(layer.counts.begin(), layer.counts.end(), [](int n) { return n > 0; });
    if (!hasModes) {
        if (layer.hasBase) clear(layer.base, from);
        layer.hasBase = layer.hasBase && from > 0;
    } else if (from == 0) {
        kernel_->render(view(layer, isGated), layer.base.data());
        layer.hasBase = true;
    } else {
        if (!layer.hasBase) std::fill_n(layer.base.data(), index(channels_) * frames, 0.0f);
        alignas(64) std::array<float, width * frames> rendered;
        kernel_->render(view(layer, isGated), rendered.data());
        for (std::size_t at = from; at < index(channels_) * frames; at += frames)
            std::copy_n(rendered.data() + at, frames - from, layer.base.data() + at);
        layer.hasBase = true;
    }
}

TileLayer ModeTiles::view(const Layer& layer, bool isGated) noexcept {
    TileLayer view{{},
                   channels_,
                   floatsPerSlot_,
                   amplitudes_.data(),
                   roundedRe_.data(),
                   roundedIm_.data(),
                   basis_->halves()};
    for (std::size_t r = 0; r < rankCount; ++r) {
        const int first = isGated ? slots_ - layer.counts[r] : 0;
        view.modes[r] = {rowAt(r, first), rowSlots_[r].data() + first, layer.counts[r], tiles::ranks[r]};
    }
    return view;
}

void ModeTiles::strike(int slot, int from, const StrikeTurns& turns, double amplitude, const double* gains,
                       Complex<double>* amplitudes) noexcept {
    const auto s = index(slot);
    const TileMode& mode = slotRows_[s].mode;
    const int count = strikes_.count;
    if (count == TileStrikes::maxCount ||
        (count > 0 && (mode.isGated != areStrikesGated_ || from < strikes_.entries[index(count - 1)].from)))
        flushStrikes();
    areStrikesGated_ = mode.isGated;
    double* const scaled = scaledGains_.data() + index(strikes_.count * channels_) * 2;
    for (std::size_t j = 0; j < index(channels_); ++j)
        scaled[2 * j] = scaled[2 * j + 1] = amplitude * gains[j];
    const auto last = index(strikes_.count++);
    strikes_.onsetPhases[last] = turns.onset.phase;
    strikes_.onsetOctaves[last] = turns.onset.octaves;
    strikes_.carrierPhases[last] = turns.carrierPhase;
    strikes_.decayOctaves[last] = turns.decayOctaves;
    strikes_.entries[last] = {mode.cosPowers,
                              mode.sinPowers,
                              &amplitudes->re,
                              amplitudes_.data() + s * index(floatsPerSlot_),
                              slot,
                              from};
}

void ModeTiles::flushStrikes() noexcept {
    Layer& layer = layers_[areStrikesGated_];
    strikes_.channels = channels_;
    strikes_.scaled = scaledGains_.data();
    strikes_.tails = layer.tails.data();
    strikes_.carriers = carriers();
    kernel_->strike(strikes_);
    strikes_.count = 0;
    layer.tailsFrom = std::min(layer.tailsFrom, strikes_.entries[0].from);
}

bool ModeTiles::findSums(const float** sums, int first) noexcept {
    finishStrikes();
    settle();
    for (std::size_t j = 0; j < index(channels_); ++j)
        sums[j] = layers_[0].base.data() + j * frames + index(first);
    return isPlain() && layers_[0].hasBase;
}

bool ModeTiles::render(float* const* out, int first, int count) noexcept {
    settle();
    const bool isStruckOnly =
        layers_[0].hasBase && layers_[0].hasTails() && !layers_[1].hasBase && !layers_[1].hasTails();
    if (isStruckOnly)
        addTails(layers_[0], out, first, count);
    else if (!isPlain())
        sum(out, first, count);
    else if (layers_[0].hasBase)
        for (std::size_t j = 0; j < index(channels_); ++j)
            std::copy_n(layers_[0].base.data() + j * frames + index(first), count, out[j]);
    else
        kernel_->clear(out, channels_, count);
    return !isPlain() || layers_[0].hasBase;
}

// Base plus tails; before the first strike the base alone.
void ModeTiles::addTails(const Layer& layer, float* const* out, int first, int count) const noexcept {
    constexpr int panel = 16; // whole vectors
    const int baseCount = std::clamp((layer.tailsFrom - first) / panel * panel, 0, count);
    for (std::size_t j = 0; j < index(channels_); ++j) {
        const std::size_t at = j * frames + index(first);
        std::copy_n(layer.base.data() + at, baseCount, out[j]);
        kernel_->sum(layer.base.data() + at + index(baseCount), layer.tails.data() + at + index(baseCount),
                     count - baseCount, out[j] + baseCount);
    }
}

void ModeTiles::sum(float* const* out, int first, int count) const noexcept {
    for (std::size_t j = 0; j < index(channels_); ++j) {
        std::array<double, frames> sums{};
        for (const auto& layer : layers_) {
            const std::size_t at = j * frames + index(first);
            for (std::size_t k = 0; layer.hasBase && k < index(count); ++k)
                sums[k] += static_cast<double>(layer.base[at + k]);
            for (std::size_t k = 0; layer.hasTails() && k < index(count); ++k) sums[k] += layer.tails[at + k];
        }
        std::transform(sums.begin(), sums.begin() + count, out[j],
                       [](double y) { return static_cast<float>(y); });
    }
}

// The polynomials by a three-term recurrence with re-orthogonalisation (Stieltjes' procedure). By symmetry
// half a tile suffices.

LowRankBasis::LowRankBasis() noexcept {
    const auto at = [this](std::size_t k, std::size_t t) -> double& { return values_[k * half + t]; };
    const auto dot = [&](std::size_t a, std::size_t b) { // over the whole tile, for two polynomials of equal
                                                         // symmetry
        double sum = 0;
        for (std::size_t t = 0; t < half; ++t) sum += 2 * at(a, t) * at(b, t);
        return sum;
    };
    for (std::size_t k = 0; k < maxRank; ++k) {
        for (std::size_t t = 0; t < half; ++t) {
            const double x = (2.0 * static_cast<double>(t) - (tiles::frames - 1)) / tiles::frames;
            at(k, t) = k == 0 ? 1.0 : x * at(k - 1, t);
        }
        for (int pass = 0; pass < 2; ++pass)
            for (std::size_t j = k % 2; j < k; j += 2) {
                const double projection = dot(k, j);
                for (std::size_t t = 0; t < half; ++t) at(k, t) -= projection * at(j, t);
            }
        const double length = std::sqrt(dot(k, k));
        for (std::size_t t = 0; t < half; ++t) at(k, t) /= length;
    }
    for (std::size_t i = 0; i < values_.size(); ++i) halves_[i] = static_cast<float>(values_[i]);
}

void LowRankBasis::project(const double* cosPowers, const double* sinPowers, int rank,
                           float* row) const noexcept {
    constexpr std::size_t frames = 2 * half;
    if (rank == tiles::frames) {
        for (std::size_t t = 0; t < frames; ++t) {
            row[2 * t] = static_cast<float>(sinPowers[t]);
            row[2 * t + 1] = static_cast<float>(cosPowers[t]);
        }
        return;
    }
    std::array<double, 4 * half> folded{}; // even and odd parts of sine and cosine
    for (std::size_t t = 0; t < half; ++t) {
        folded[t] = sinPowers[t] + sinPowers[frames - 1 - t];
        folded[half + t] = cosPowers[t] + cosPowers[frames - 1 - t];
        folded[2 * half + t] = sinPowers[t] - sinPowers[frames - 1 - t];
        folded[3 * half + t] = cosPowers[t] - cosPowers[frames - 1 - t];
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k) {
        const double* parts = folded.data() + k % 2 * 2 * half;
        double sine = 0, cosine = 0;
        for (std::size_t t = 0; t < half; ++t) {
            sine += values_[k * half + t] * parts[t];
            cosine += values_[k * half + t] * parts[half + t];
        }
        row[2 * k] = static_cast<float>(sine);
        row[2 * k + 1] = static_cast<float>(cosine);
    }
}

int LowRankBasis::rankFor(double radians) noexcept {
    return radians < 0.0275 ? 8 : radians < 0.145 ? 16 : radians < 0.5 ? 32 : 64;
}

} // namespace physvib
