// SPDX-License-Identifier: GPL-3.0-or-later
// What instructions.sh counts: CHANNELS, STRIKES a second on so many MODES; of so many SECONDS the last one,
// in the function `counted`. STRIKES -1: the bank of modes alone, struck at the first frame.
#include "Rain.h"
#include <cstdlib>
#include <functional>

using namespace physvib;

class BankAlone {
public:
    BankAlone(int channels, int modes)
        : memory_(static_cast<std::size_t>(channels * bench::blockFrames)) {
        bank_->prepare(bench::rate, channels);
        PhantomPanner::Gains gains{};
        gains.fill(0.5f);
        for (int i = 0; i < modes; ++i)
            bank_->strike({20 * std::pow(50.0, (i + 0.5) / modes), 1.0, 0.01, {}, Strike::never},
                          gains.data());
        for (int j = 0; j < channels; ++j) at_.push_back(memory_.data() + j * bench::blockFrames);
    }
    void seconds(double s) noexcept {
        for (int i = 0; i < s * bench::rate / bench::blockFrames; ++i, frame_ += bench::blockFrames)
            bank_->render(at_.data(), frame_, bench::blockFrames);
    }

private:
    std::unique_ptr<ModeBank> bank_ = std::make_unique<ModeBank>();
    std::vector<float> memory_;
    std::vector<float*> at_;
    std::int64_t frame_ = 0;
};

extern "C" [[gnu::noinline]] void plural(const std::function<void()>& second) { second(); }

template <class Played>
int run(Played&& played, double seconds) {
    played.seconds(seconds - 1.0);
    plural([&played] { played.seconds(1.0); });
    return 0;
}

int main(int count, char** arguments) {
    if (count != 5) return 2;
    const int channels = std::atoi(arguments[1]), strikes = std::atoi(arguments[2]),
              modes = std::atoi(arguments[3]);
    const double seconds = std::atof(arguments[4]);
    return strikes < 0 ? run(BankAlone{channels, modes}, seconds)
                       : run(bench::RainedOn{channels, strikes, modes}, seconds);
}
