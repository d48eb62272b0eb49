// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "image/windows/resvg.h"

namespace droplet {

/// A drawing that is rewritten for resvg and asked for what resvg does not tell.
class SvgDocument {
public:
    /// Writes the shorthand `font`, which resvg does not know, as its parts.
    /// @throws Error InvalidInput: no XML, or its element is not svg
    explicit SvgDocument(std::span<const std::byte> text);
    ~SvgDocument();
    SvgDocument(const SvgDocument&) = delete;
    SvgDocument& operator=(const SvgDocument&) = delete;

    /// The drawing in UTF-8.
    [[nodiscard]] std::string text() const;

    /// Page [CSS px], and its physical width [m] if it states one.
    struct Page {
        double width = 0.0;
        double height = 0.0;
        std::optional<double> physical_width;
    };

    /// Finds the page's size and writes it into the drawing.
    /// @param ink  bounds of what is drawn, for a page without any size
    /// @return     none if that draws nothing, either
    std::optional<Page> page(const std::function<std::optional<Resvg::Box>()>& ink);

    /// Families of its texts, each with those that may stand for it; empty if it has no text.
    [[nodiscard]] std::set<std::vector<std::string>> families() const;

    /// What is not drawn, as the other systems' programs name it.
    [[nodiscard]] std::vector<std::string> lacking() const;

private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace droplet
