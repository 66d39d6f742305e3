// SPDX-License-Identifier: GPL-3.0-or-later
// Computes features from events and samples; the columns are described in Docs/render.md.
#include "CommandLine/Sweep/SweepFeatures.h"
#include "Calls/LoadedRender.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace physvib {
namespace {

constexpr std::array<int, 5> bandEdgesHz{50, 100, 200, 400, 800};

std::string bandName(std::size_t band) {
    const int from = band == 0 ? 0 : bandEdgesHz[band - 1];
    return "band_" + std::to_string(from) +
           (band < bandEdgesHz.size() ? '_' + std::to_string(bandEdgesHz[band]) : "_up");
}

std::string channelName(const char* what, int channel) {
    return std::string(what) + '_' + std::to_string(channel + 1);
}

/// Weighted mean and spread of places.
struct PlaceSum {
    double weight = 0.0, x = 0.0, y = 0.0, squares = 0.0;
    void add(double w, double atX, double atY) {
        weight += w;
        x += w * atX;
        y += w * atY;
        squares += w * (atX * atX + atY * atY);
    }
    std::optional<double> of(double sum) const {
        return weight > 0.0 ? std::optional{sum / weight} : std::nullopt;
    }
    std::optional<double> spread() const {
        if (!(weight > 0.0)) return std::nullopt;
        return std::sqrt(std::max(0.0, squares / weight - (x * x + y * y) / (weight * weight)));
    }
};

} // namespace

std::vector<std::string> SweepFeatures::names(int channels) {
    LayoutDescription layout;
    layout.geometry.count = channels;
    layout.enchanters.resize(static_cast<std::size_t>(channels));
    SweepFeatures silence;
    silence.prepare(layout, limits::minSampleRateHz, 1.0);
    silence.measureEvents({});
    std::vector<std::string> names;
    for (SweepFeature& feature : silence.finish()) names.push_back(std::move(feature.name));
    return names;
}

void SweepFeatures::prepare(const LayoutDescription& layout, int sampleRateHz, double seconds) {
    layout_ = layout;
    seconds_ = seconds;
    meter_ = std::make_unique<ExposureMeter>();
    meter_->prepare(sampleRateHz);
    spectrum_.emplace(sampleRateHz, layout_.geometry.count);
}

void SweepFeatures::begin(const LoadedRender& job) {
    prepare(job.layout, job.options.sampleRateHz, job.seconds());
    const auto& events = job.made.events;
    const auto end = std::ranges::lower_bound(events, job.endNs(), {}, &CollisionEvent::timeNs);
    measureEvents({events.begin(), end});
}

void SweepFeatures::measureEvents(std::span<const CollisionEvent> events) {
    double hits = 0.0, sum = 0.0, largest = 0.0, amplitude = 0.0, gaps = 0.0, squaredGaps = 0.0;
    std::optional<double> first, last;
    PlaceSum place;
    for (const CollisionEvent& e : events) {
        if (e.source.kind != ContactKind::hit) continue;
        const double seconds = static_cast<double>(e.timeNs) * 1e-9, gap = seconds - last.value_or(seconds);
        hits += 1.0;
        gaps += gap;
        squaredGaps += gap * gap;
        last = seconds;
        if (!first) first = seconds;
        sum += e.source.impulseNewtonSeconds;
        largest = std::max(largest, e.source.impulseNewtonSeconds);
        amplitude = std::max(amplitude, std::abs(e.amplitude));
        place.add(std::abs(e.amplitude), e.x, e.y);
    }
    const auto perGap = [&](double of) {
        return hits > 1.0 ? std::optional{of / (hits - 1.0)} : std::nullopt;
    };
    const auto mean = perGap(gaps), square = perGap(squaredGaps);
    add("hits", hits);
    add("grains", static_cast<double>(events.size()) - hits);
    add("first_s", first);
    add("last_s", last);
    add("gap_mean_s", mean);
    add("gap_deviation_s",
        mean ? std::optional{std::sqrt(std::max(0.0, *square - *mean * *mean))} : std::nullopt);
    add("impulse_sum_ns", sum);
    add("impulse_max_ns", largest);
    add("amplitude_max", amplitude);
    add("hit_x_m", place.of(place.x));
    add("hit_y_m", place.of(place.y));
    add("hit_spread_m", place.spread());
}

void SweepFeatures::take(const float* const* channels, int frames) {
    for (int j = 0; j < layout_.geometry.count; ++j) meter_->take(j, channels[j], frames);
    spectrum_->add(channels, frames);
}

std::vector<SweepFeature> SweepFeatures::finish() {
    measureLevels();
    return std::move(features_);
}

void SweepFeatures::measureLevels() {
    meter_->publish();
    const ExposureSums& sums = meter_->read();
    PlaceSum felt;
    double squareGSeconds = 0.0;
    for (std::size_t j = 0; j < layout_.enchanters.size(); ++j) {
        const double fullScaleG = layout_.enchanters[j].fullScaleG;
        squareGSeconds += sums.weighted[j] * fullScaleG * fullScaleG;
        felt.add(sums.plain[j] * fullScaleG * fullScaleG, layout_.geometry.places[j].xMetres,
                 layout_.geometry.places[j].yMetres);
    }
    add("felt_x_m", felt.of(felt.x));
    add("felt_y_m", felt.of(felt.y));
    add("a8_m_per_s2", dailyExposure(squareGSeconds));
    measureSpectrum();
    for (int j = 0; j < layout_.geometry.count; ++j)
        add(channelName("peak", j), sums.peaks[static_cast<std::size_t>(j)]);
    for (int j = 0; j < layout_.geometry.count; ++j)
        add(channelName("rms", j), std::sqrt(sums.plain[static_cast<std::size_t>(j)] / seconds_));
}

void SweepFeatures::measureSpectrum() {
    const auto shares = spectrum_->finish();
    std::array<double, bandEdgesHz.size() + 1> bands{};
    double whole = 0.0, mean = 0.0, square = 0.0;
    for (std::size_t k = 0; k < shares.size(); ++k) {
        const double hz = static_cast<double>(k) * spectrum_->binHz();
        whole += shares[k];
        mean += hz * shares[k];
        square += hz * hz * shares[k];
        bands[static_cast<std::size_t>(std::ranges::upper_bound(bandEdgesHz, hz) - bandEdgesHz.begin())] +=
            shares[k];
    }
    const auto ofSound = [&](double value) { return whole > 0.0 ? std::optional{value} : std::nullopt; };
    add("centroid_hz", ofSound(mean));
    add("bandwidth_hz", ofSound(std::sqrt(std::max(0.0, square - mean * mean))));
    for (std::size_t band = 0; band < bands.size(); ++band) add(bandName(band), ofSound(bands[band]));
}

} // namespace physvib
