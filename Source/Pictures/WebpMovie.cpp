// SPDX-License-Identifier: MIT
#include "Pictures/WebpMovie.h"
#include <stdexcept>
#include <webp/encode.h>
#include <webp/mux.h>

namespace physvib {

namespace {

constexpr float quality = 78.0f; // of libwebp's 0 to 100: words stay sharp, ten seconds of a scene take about
                                 // a megabyte
constexpr int method = 3;        // of 0 to 6: slower is a few per cent smaller

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error{"no WebP could be made: " + why}; }

} // namespace

struct WebpMovie::Encoder {
    WebPAnimEncoder* animation = nullptr;
    WebPConfig config{};
    int width, height;

    Encoder(int w, int h)
        : width{w}
        , height{h} {
        WebPAnimEncoderOptions options{};
        if (!WebPAnimEncoderOptionsInit(&options) || !WebPConfigInit(&config))
            fail("another version of libwebp");
        config.quality = quality, config.method = method;
        animation = WebPAnimEncoderNew(w, h, &options);
        if (animation == nullptr) fail("memory");
    }
    ~Encoder() { WebPAnimEncoderDelete(animation); }
    Encoder(const Encoder&) = delete;
    Encoder& operator=(const Encoder&) = delete;
};

WebpMovie::WebpMovie(int width, int height)
    : encoder_{std::make_unique<Encoder>(width, height)} {}
WebpMovie::~WebpMovie() = default;

void WebpMovie::add(const picture::Image& image, std::int64_t timeMs) {
    WebPPicture picture{};
    if (!WebPPictureInit(&picture)) fail("another version of libwebp");
    picture.use_argb = 1, picture.width = encoder_->width, picture.height = encoder_->height;
    const bool isAdded =
        WebPPictureImportRGB(&picture, image.rgb(), 3 * image.width()) &&
        WebPAnimEncoderAdd(encoder_->animation, &picture, static_cast<int>(timeMs), &encoder_->config);
    WebPPictureFree(&picture);
    if (!isAdded) fail(WebPAnimEncoderGetError(encoder_->animation));
}

std::string WebpMovie::bytes(std::int64_t endMs) {
    WebPData data{};
    WebPDataInit(&data);
    if (!WebPAnimEncoderAdd(encoder_->animation, nullptr, static_cast<int>(endMs), nullptr) ||
        !WebPAnimEncoderAssemble(encoder_->animation, &data))
        fail(WebPAnimEncoderGetError(encoder_->animation));
    std::string all(reinterpret_cast<const char*>(data.bytes), data.size);
    WebPDataClear(&data);
    return all;
}

} // namespace physvib
