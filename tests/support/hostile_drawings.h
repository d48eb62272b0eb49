// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace droplet::testing {

/// Short drawing that requires huge work.
struct HostileDrawing {
    std::string name;
    std::function<std::string()> text;
};

inline std::string svgText(const std::string& content)
{
    return R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" viewBox="0 0 10 10">)" +
           content + "</svg>";
}

/// Concatenation of piece(0) … piece(count − 1).
inline std::string repeated(int count, const std::function<std::string(int i)>& piece)
{
    std::string all;
    for (int i = 0; i < count; ++i) {
        all += piece(i);
    }
    return all;
}

inline std::string repeated(int count, const std::string& piece)
{
    return repeated(count, [&](int) { return piece; });
}

/// Elements each of which refers to the one before by `link`, where @ is replaced by its number.
inline std::string chained(int count, const std::string& first, const std::string& link)
{
    return "<defs>" + first +
           repeated(count - 1,
                    [&](int i) {
                        std::string next = link;
                        next.replace(next.find('@'), 1, std::to_string(i + 1));
                        next.replace(next.find('@'), 1, std::to_string(i));
                        return next;
                    }) +
           "</defs>";
}

inline std::string filtered(const std::string& primitive)
{
    return "<filter id='f' x='0' y='0' width='1' height='1'>" + primitive +
           "</filter><rect width='10' height='10' filter='url(#f)'/>";
}

inline std::vector<HostileDrawing> hostileDrawings()
{
    const auto drawing = [](const std::string& name, std::function<std::string()> content) {
        return HostileDrawing{name, [content = std::move(content)] { return svgText(content()); }};
    };
    const std::string square = "<rect width='9' height='9'/>";
    return {
        drawing("nested_groups", [=] { return repeated(20'000, "<g>") + square + repeated(20'000, "</g>"); }),
        drawing("nested_opacity", [=] { return repeated(250, "<g opacity='.99'>") + square + repeated(250, "</g>"); }),
        drawing("nested_filters",
                [=] {
                    return "<filter id='f'><feGaussianBlur stdDeviation='1'/></filter>" +
                           repeated(250, "<g filter='url(#f)'>") + square + repeated(250, "</g>");
                }),
        drawing("nested_patterns",
                [=] {
                    return chained(30'000, "<pattern id='a0' width='1' height='1'>" + square + "</pattern>",
                                   "<pattern id='a@' width='1' height='1'><rect width='9' height='9' "
                                   "fill='url(#a@)'/></pattern>") +
                           "<rect width='5' height='5' fill='url(#a29999)'/>";
                }),
        drawing("nested_masks",
                [=] {
                    return chained(2'000, "<mask id='a0'>" + square + "</mask>",
                                   "<mask id='a@'><rect width='9' height='9' mask='url(#a@)'/></mask>") +
                           "<rect width='5' height='5' mask='url(#a1999)'/>";
                }),
        drawing("nested_clips",
                [=] {
                    return chained(40'000, "<clipPath id='a0'>" + square + "</clipPath>",
                                   "<clipPath id='a@' clip-path='url(#a@)'><rect width='9' height='9'/></clipPath>") +
                           "<rect width='5' height='5' clip-path='url(#a39999)'/>";
                }),
        drawing("nested_uses",
                [=] {
                    return chained(60'000, "<rect id='a0' width='5' height='5'/>", "<use id='a@' xlink:href='#a@'/>") +
                           "<use xlink:href='#a59999'/>";
                }),
        drawing("use_of_uses",
                [=] {
                    return "<defs><rect id='a0' width='9' height='9' opacity='.5'/>" +
                           repeated(7,
                                    [](int i) {
                                        return "<g id='a" + std::to_string(i + 1) + "'>" +
                                               repeated(10, "<use xlink:href='#a" + std::to_string(i) + "'/>") + "</g>";
                                    }) +
                           "</defs><use xlink:href='#a7'/>";
                }),
        drawing("blur", [=] { return filtered("<feGaussianBlur stdDeviation='1000000'/>"); }),
        drawing("many_blurs", [=] { return filtered(repeated(10'000, "<feGaussianBlur stdDeviation='3'/>")); }),
        drawing("turbulence", [=] { return filtered("<feTurbulence baseFrequency='.7' numOctaves='1000000000'/>"); }),
        drawing("morphology", [=] { return filtered("<feMorphology operator='dilate' radius='1000000'/>"); }),
        drawing(
            "convolution",
            [=] { return filtered("<feConvolveMatrix order='300' kernelMatrix='" + repeated(90'000, "1 ") + "'/>"); }),
        drawing("large_filter",
                [=] {
                    return "<filter id='f' x='-1000' y='-1000' width='2000' height='2000'><feFlood/></filter>" +
                           square + "<rect width='1e6' height='1e6' filter='url(#f)'/>";
                }),
        drawing("dashes",
                [=] {
                    return std::string(
                        "<path d='M0 0H1e6V1e6H-1e6z' fill='none' stroke='red' stroke-width='1' "
                        "stroke-dasharray='1e-5 1e-5'/>");
                }),
        drawing("long_text", [=] { return "<text x='1' y='8'>" + std::string(1'000'000, 'W') + "</text>"; }),
        drawing("large_text", [=] { return "<text y='10' font-size='1000000'>Wg</text>" + square; }),
        drawing("many_paths",
                [=] {
                    return repeated(100'000, [](int i) {
                        return "<path d='M0 0C9 0 9 9 0 9L" + std::to_string(i % 10) + " 5z' stroke='red'/>";
                    });
                }),
        drawing("long_path",
                [=] {
                    return "<path stroke='red' stroke-width='3' stroke-linejoin='round' d='M0 0" +
                           repeated(200'000,
                                    [](int i) { return (i % 2 == 0 ? "L9 " : "L0 ") + std::to_string(i % 997); }) +
                           "'/>";
                }),
        drawing("many_markers",
                [=] {
                    return "<marker id='m' overflow='visible'>" + square +
                           "</marker><path marker-mid='url(#m)' d='M0 0" +
                           repeated(100'000, [](int i) { return "L" + std::to_string(i % 10) + " 5"; }) + "'/>";
                }),
        drawing("many_stops",
                [=] {
                    return "<linearGradient id='l'>" +
                           repeated(100'000,
                                    [](int i) { return "<stop offset='" + std::to_string(1e-5 * i) + "'/>"; }) +
                           "</linearGradient><rect width='10' height='10' fill='url(#l)'/>";
                }),
        drawing("many_rules",
                [=] {
                    return "<style>" + repeated(20'000, "g g g g g rect{fill:red}") + "</style><g><g><g><g>" +
                           repeated(20'000, "<rect/>") + "</g></g></g></g>";
                }),
        drawing("tiny_tiles",
                [=] {
                    return "<pattern id='p' width='1e-6' height='1e-6' patternUnits='userSpaceOnUse'>" + square +
                           "</pattern><rect width='10' height='10' fill='url(#p)'/>";
                }),
        drawing(
            "endless_numbers",
            [=] {
                return "<g transform='scale(1e308) scale(1e308)'>" + square +
                       "</g><circle r='1e300' stroke='red' stroke-width='1e-300'/><path d='M1e308 -1e308L1e39 0z'/>" +
                       "<text font-size='1e-30'>W</text><text font-size='1e300'>W</text>" + square;
            }),
    };
}

}  // namespace droplet::testing
