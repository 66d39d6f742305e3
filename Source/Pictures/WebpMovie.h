// SPDX-License-Identifier: MIT
// Encoder of movies as animated WebP, by libwebp.
#pragma once
#include "Pictures/Image.h"
#include <cstdint>
#include <memory>
#include <string>

namespace physvib {

/// Takes pictures of one size in the order of their times. One thread at a time. What libwebp refuses is
/// thrown as std::runtime_error.
class WebpMovie {
public:
    WebpMovie(int width, int height);
    ~WebpMovie();
    WebpMovie(const WebpMovie&) = delete;
    WebpMovie& operator=(const WebpMovie&) = delete;

    void add(const picture::Image& image, std::int64_t timeMs); ///< shown from then on

    /// All of the file, once; the last picture is shown until `endMs`. It is played again and again.
    std::string bytes(std::int64_t endMs);

private:
    struct Encoder;
    std::unique_ptr<Encoder> encoder_;
};

} // namespace physvib
