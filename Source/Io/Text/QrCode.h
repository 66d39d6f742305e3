// SPDX-License-Identifier: MIT
// A text as a QR code. Programs that include this link the library qrcodegen.
#pragma once
#include <cstdint>
#include <qrcodegen.h>
#include <string>

namespace physvib {

/// The square pattern of modules, light or dark, that encodes a text. One thread at a time.
class QrCode {
public:
    static constexpr int quietModules = 4; ///< light modules around the code that readers need

    explicit QrCode(const std::string& text) {
        std::string scratch(qrcodegen_BUFFER_LEN_MAX, '\0');
        modules_.resize(scratch.size());
        if (!qrcodegen_encodeText(text.c_str(), bytes(scratch), bytes(modules_), qrcodegen_Ecc_LOW,
                                  qrcodegen_VERSION_MIN, qrcodegen_VERSION_MAX, qrcodegen_Mask_AUTO, true))
            modules_.clear();
    }
    /// Number of modules per side; 0: the text is too long for a QR code.
    int side() { return modules_.empty() ? 0 : qrcodegen_getSize(bytes(modules_)); }
    bool isDark(int x, int y) { return qrcodegen_getModule(bytes(modules_), x, y); }

private:
    static std::uint8_t* bytes(std::string& text) { return reinterpret_cast<std::uint8_t*>(text.data()); }
    std::string modules_;
};

} // namespace physvib
