// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace droplet {

/// Why resvg has not drawn.
class ResvgError : public std::runtime_error {
public:
    enum class Cause { Damaged, Time, Memory, Depth, Other };

    ResvgError(Cause cause, const std::string& what) : std::runtime_error(what), cause(cause) {}

    Cause cause;
};

struct ResvgLimits {
    double seconds = 0.0;    ///< from the construction of Resvg
    std::size_t memory = 0;  ///< [bytes]
};

/// Fonts for a drawing.
struct ResvgFonts {
    std::vector<std::vector<std::uint8_t>> files;
    std::string names = "{}";  ///< families for the generic ones: JSON, as resvg-js takes it
};

/// The library resvg, as C made from its WebAssembly. It reaches nothing but its own memory: a drawing that makes it
/// fail harms nothing, and takes no more time and memory than its limits. There is one at a time; other threads wait.
class Resvg {
public:
    explicit Resvg(const ResvgLimits& limits);
    ~Resvg();
    Resvg(const Resvg&) = delete;
    Resvg& operator=(const Resvg&) = delete;

    /// Rectangle [CSS px].
    struct Box {
        double x = 0.0;
        double y = 0.0;
        double width = 0.0;
        double height = 0.0;
    };

    /// Size of a drawing's page.
    /// @throws ResvgError
    Box page(const std::string& svg, const ResvgFonts& fonts);

    /// What a drawing covers; none if it draws nothing.
    /// @throws ResvgError
    std::optional<Box> ink(const std::string& svg, const ResvgFonts& fonts);

    /// Pixels of a drawing: premultiplied red, green, blue and alpha, in rows of `width`.
    /// @throws ResvgError
    std::vector<std::uint8_t> pixels(const std::string& svg, const ResvgFonts& fonts, int width);

private:
    struct Module;
    std::unique_ptr<Module> module_;
};

}  // namespace droplet
