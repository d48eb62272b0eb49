// SPDX-License-Identifier: GPL-3.0-or-later
// After: SVG 2; CSS Transforms 1 and 2; CSS Masking 1, 5; CSS Shapes 1, 3; CSS Custom Properties 1 (W3C).
//
// The drawing becomes a tree of libxml2. In a first walk, variables and calculations in values are replaced by what
// they give. In a second walk, from the innermost elements outwards, transformations get their origin. In a third one,
// clips and strokes follow, which depend on transformations. New values are written into the style attribute,
// which wins over rules; transformations are attributes, which win in librsvg. Bounding boxes are asked of librsvg.
#include "image/svg/rewrite.h"

#include <dlfcn.h>
#include <fmt/core.h>
#include <librsvg/rsvg.h>
#include <libxml/tree.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include "image/svg/css_text.h"
#include "image/svg/drawing_tree.h"
#include "image/svg/style_sheet.h"

namespace droplet {
namespace {

constexpr std::size_t kMaxText = std::size_t{8} << 20;  // a tree takes some twenty times as much memory
constexpr std::size_t kMaxValue = std::size_t{1} << 16;
constexpr std::string_view kShapes[] = {"circle", "ellipse", "inset", "polygon", "path", "rect", "xywh"};

/// Sets a property so that it wins over rules. librsvg misreads some values that are marked as important.
void setProperty(xmlNode& element, const std::string& name, const std::string& value)
{
    std::string style;
    for (const Declaration& declaration : parseDeclarations(attributeOf(element, "style").value_or(""))) {
        if (declaration.name != name) {
            style += declaration.name + ":" + declaration.value + (declaration.important ? "!important;" : ";");
        }
    }
    setAttribute(element, "style", style + name + ":" + value);
}

using Box = SvgBox;

/// Bounding boxes of an element.
struct Boxes {
    Box fill;
    Box stroke;
};

/// Size to which percentages refer: that of the nearest svg element's viewBox, or its own.
Box viewportOf(const xmlNode& element)
{
    for (const xmlNode* here = element.parent; isElement(here); here = here->parent) {
        if (nameOf(*here) == "svg") {
            const auto box = viewBoxOf(*here);
            return box ? Box{0.0, 0.0, box->width, box->height}
                       : Box{0.0, 0.0, pixelsOf(*here, "width").value_or(100.0),
                             pixelsOf(*here, "height").value_or(100.0)};
        }
    }
    return {0.0, 0.0, 100.0, 100.0};
}

/// Families of installed fonts in lower case, from Pango, which librsvg has loaded; none if it cannot be asked.
const std::set<std::string>& installedFonts()
{
    static const std::set<std::string> fonts = [] {
        std::set<std::string> names;
        const auto map = reinterpret_cast<void* (*)()>(dlsym(RTLD_DEFAULT, "pango_cairo_font_map_get_default"));
        const auto list =
            reinterpret_cast<void (*)(void*, void***, int*)>(dlsym(RTLD_DEFAULT, "pango_font_map_list_families"));
        const auto name = reinterpret_cast<const char* (*)(void*)>(dlsym(RTLD_DEFAULT, "pango_font_family_get_name"));
        if (map == nullptr || list == nullptr || name == nullptr) {
            return names;
        }
        void** families = nullptr;
        int count = 0;
        list(map(), &families, &count);
        for (int k = 0; k < count; ++k) {
            names.insert(lowered(name(families[k])));
        }
        g_free(families);
        return names;
    }();
    return fonts;
}

/// Part of a box's side from its beginning: a percentage, a keyword or a length.
std::optional<double> along(std::string_view text, double side)
{
    const std::string word = lowered(text);
    if (word == "left" || word == "top") {
        return 0.0;
    }
    if (word == "center") {
        return 0.5 * side;
    }
    if (word == "right" || word == "bottom") {
        return side;
    }
    const auto quantity = parseQuantity(word);
    if (!quantity || quantity->unit == "deg") {
        return std::nullopt;
    }
    return quantity->unit == "%" ? quantity->value / 100.0 * side : quantity->value;
}

/// Point in a box: one or two words, as of transform-origin.
std::optional<std::array<double, 2>> placeIn(const Box& box, std::vector<std::string_view> words)
{
    const auto is_any = [](std::string_view word, std::string_view a, std::string_view b) {
        return lowered(word) == a || lowered(word) == b;
    };
    if (words.empty()) {
        return std::nullopt;
    }
    if (words.size() == 1) {
        words.emplace_back("center");
    }
    if (is_any(words[0], "top", "bottom") || is_any(words[1], "left", "right")) {
        std::swap(words[0], words[1]);
    }
    const auto x = along(words[0], box.width);
    const auto y = along(words[1], box.height);
    return x && y ? std::optional(std::array{box.x + *x, box.y + *y}) : std::nullopt;
}

class Rewriting {
public:
    explicit Rewriting(xmlDoc* document) : document_(document), root_(*xmlDocGetRootElement(document)), styles_(root_)
    {
    }

    Rewritten run()
    {
        for (const StyleRule& rule : styles_.rules()) {
            for (const Declaration& declaration : rule.declarations) {
                if (needsValue(declaration.value) && !declaration.name.starts_with("--")) {
                    in_rules_.insert(declaration.name);
                }
            }
        }
        collect();
        for (xmlNode* element : elements_) {
            replaceValues(*element);
        }
        for (std::size_t k = elements_.size(); k > 0; --k) {
            placeTransform(*elements_[k - 1]);
        }
        for (xmlNode* element : elements_) {
            replaceClip(*element);
            fixStroke(*element);
            noteMissing(*element);
        }
        if (styles_.atRules().contains("@import")) {
            note("imported style sheets");
        }
        for (const xmlNode* node = document_->children; node != nullptr; node = node->next) {
            if (node->type == XML_PI_NODE &&
                std::strcmp(reinterpret_cast<const char*>(node->name), "xml-stylesheet") == 0) {
                note("linked style sheets");
            }
        }
        return {is_changed_ ? textOf(document_) : "", std::move(not_drawn_)};
    }

private:
    static constexpr std::size_t kMaxBoxes = 64;

    static bool needsValue(std::string_view value)
    {
        return findFunction(value, {"var", "calc", "min", "max", "clamp"}).has_value();
    }

    void note(const std::string& what)
    {
        constexpr std::size_t kMax = 12;
        if (not_drawn_.size() < kMax && std::find(not_drawn_.begin(), not_drawn_.end(), what) == not_drawn_.end()) {
            not_drawn_.push_back(what);
        }
    }

    void set(xmlNode& element, const std::string& name, const std::string& value)
    {
        setProperty(element, name, value);
        is_changed_ = true;
    }

    /// Elements of the drawing, the outer ones first.
    void collect()
    {
        std::vector<xmlNode*> open{&root_};
        while (!open.empty()) {
            xmlNode* const element = open.back();
            open.pop_back();
            elements_.push_back(element);
            for (xmlNode* child = element->last; child != nullptr; child = child->prev) {
                if (isElement(child) && isDrawn(*child) && nameOf(*element) != "foreignObject") {
                    open.push_back(child);
                }
            }
        }
    }

    /// Value without variables and calculations; none if it is not valid.
    std::optional<std::string> resolved(const xmlNode& element, std::string value, int depth = 0)
    {
        constexpr int kMaxDepth = 16;
        while (const auto variable = findFunction(value, {"var"})) {
            const std::size_t comma = variable->content.find(',');
            const std::string name(trimmed(variable->content.substr(0, comma)));
            const auto custom = styles_.inherited(element, name);
            std::optional<std::string> given;
            if (depth < kMaxDepth && custom && lowered(custom->value) != "initial") {
                given = resolved(element, custom->value, depth + 1);
            }
            if (depth < kMaxDepth && !given && comma != std::string_view::npos) {
                given = resolved(element, std::string(trimmed(variable->content.substr(comma + 1))), depth + 1);
            }
            if (!given || value.size() + given->size() > kMaxValue) {
                return std::nullopt;
            }
            value.replace(variable->begin, variable->end - variable->begin, *given);
        }
        while (const auto sum = findFunction(value, {"calc", "min", "max", "clamp"})) {
            const auto quantity = parseQuantity(std::string_view(value).substr(sum->begin, sum->end - sum->begin));
            if (!quantity) {
                note("calc() of percentages or of units of a font");
                return std::nullopt;
            }
            value.replace(sum->begin, sum->end - sum->begin, text(*quantity));
        }
        return value;
    }

    void replaceValues(xmlNode& element)
    {
        std::set<std::string> names = in_rules_;
        if (const auto style = attributeOf(element, "style")) {
            for (const Declaration& declaration : parseDeclarations(*style)) {
                if (needsValue(declaration.value) && !declaration.name.starts_with("--")) {
                    names.insert(declaration.name);
                }
            }
        }
        std::map<std::string, std::string> attributes;
        for (const xmlAttr* each = element.properties; each != nullptr; each = each->next) {
            const std::string name(reinterpret_cast<const char*>(each->name));
            const std::string value = attributeOf(element, name.c_str()).value_or("");
            if (each->ns == nullptr && name != "style" && name != "d" && name != "points" && needsValue(value)) {
                attributes.emplace(name, value);
            }
        }
        for (const auto& [name, value] : attributes) {
            if (const auto result = resolved(element, value)) {
                setAttribute(element, name.c_str(), *result);
                is_changed_ = true;
            }
        }
        for (const std::string& name : names) {
            const auto value = styles_.own(element, name);
            const auto result = value && !value->is_attribute && needsValue(value->value)
                                    ? resolved(element, value->value)
                                    : std::nullopt;
            if (result) {
                set(element, name, *result);
            }
        }
        if (const auto path = styles_.own(element, "d"); path && !path->is_attribute) {
            const auto function = findFunction(path->value, {"path"});
            const std::string_view quoted = function ? trimmed(function->content) : std::string_view();
            if (quoted.size() > 2) {
                setAttribute(element, "d", std::string(quoted.substr(1, quoted.size() - 2)));
                is_changed_ = true;
            }
        }
    }

    std::optional<Matrix> transformOf(const xmlNode& element) const
    {
        if (const auto placed = placed_.find(&element); placed != placed_.end()) {
            return placed->second;
        }
        const auto value = styles_.own(element, "transform");
        return value ? parseTransform(value->value) : Matrix{};
    }

    /// Writes transformations around their origin, and properties that transform, as one map.
    void placeTransform(xmlNode& element)
    {
        const auto origin = styles_.own(element, "transform-origin");
        const auto box_name = styles_.own(element, "transform-box");
        Matrix before;
        bool has_properties = false;
        for (const std::string name : {"translate", "rotate", "scale"}) {
            const auto value = styles_.own(element, name);
            if (!value || value->is_attribute || lowered(value->value) == "none") {
                continue;
            }
            std::string arguments;
            for (const std::string_view part : partsOf(value->value, ',')) {
                arguments += (arguments.empty() ? "" : ",") + std::string(part);
            }
            const auto matrix = parseTransform(fmt::format("{}({})", name, arguments));
            if (!matrix) {
                note("the property " + name + " in three dimensions or with percentages");
                return;
            }
            before = before * *matrix;
            has_properties = true;
        }
        const auto own = styles_.own(element, "transform");
        // librsvg lets the attribute win over styles.
        const bool has_both = own && !own->is_attribute && attributeOf(element, "transform");
        if ((!origin && !box_name && !has_properties && !has_both) || &element == &root_) {
            return;
        }
        if (!has_properties && !has_both && (!own || lowered(trimmed(own->value)) == "none")) {
            return;
        }
        const auto matrix = transformOf(element);
        const std::string kind = box_name ? lowered(trimmed(box_name->value)) : "view-box";
        std::optional<Box> box;
        if (kind == "view-box") {
            box = viewportOf(element);
        } else if (const auto boxes = boxesOf(element)) {
            box = kind == "stroke-box" || kind == "border-box" ? boxes->stroke : boxes->fill;
        }
        std::vector<std::string_view> words{"0", "0"};
        if (origin) {
            words = partsOf(origin->value, ',');
        }
        const auto place = box ? placeIn(*box, words) : std::nullopt;
        if (!matrix || !place) {
            note("transform-origin of this kind");
            return;
        }
        const auto [x, y] = *place;
        const Matrix whole = Matrix{1, 0, 0, 1, x, y} * before * *matrix * Matrix{1, 0, 0, 1, -x, -y};
        setAttribute(element, "transform", text(whole));
        placed_.emplace(&element, whole);
        is_changed_ = true;
    }

    /// Bounding boxes of an element in its own coordinates.
    std::optional<Boxes> boxesOf(xmlNode& element)
    {
        if (++boxes_asked_ > kMaxBoxes) {
            return std::nullopt;
        }
        std::string id = attributeOf(element, "id").value_or("");
        if (id.empty()) {
            id = fmt::format("droplet-{}", boxes_asked_);
            setAttribute(element, "id", id);
        }
        const DrawingTree copy(xmlCopyDoc(document_, 1), xmlFreeDoc);
        xmlNode* const root = copy ? xmlDocGetRootElement(copy.get()) : nullptr;
        xmlNode* const found = root == nullptr ? nullptr : elementOf(*root, id);
        for (xmlNode* node = found; isElement(node); node = node->parent) {
            setAttribute(*node, "transform", "translate(0)");
            setProperty(*node, "clip-path", "none");
            if (nameOf(*node) == "svg") {
                for (const char* name : {"viewBox", "x", "y", "width", "height"}) {
                    xmlUnsetProp(node, reinterpret_cast<const xmlChar*>(name));
                }
            }
        }
        const std::string drawing = found == nullptr ? "" : textOf(copy.get());
        RsvgHandle* const handle =
            rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(drawing.data()), drawing.size(), nullptr);
        if (handle == nullptr) {
            return std::nullopt;
        }
        const Box viewport = viewportOf(element);
        const RsvgRectangle page{0.0, 0.0, viewport.width, viewport.height};
        RsvgRectangle ink{};
        RsvgRectangle fill{};
        const bool is_known =
            rsvg_handle_get_geometry_for_layer(handle, ("#" + id).c_str(), &page, &ink, &fill, nullptr) != FALSE;
        g_object_unref(handle);
        return is_known ? std::optional(
                              Boxes{{fill.x, fill.y, fill.width, fill.height}, {ink.x, ink.y, ink.width, ink.height}})
                        : std::nullopt;
    }

    /// Writes a basic shape of clip-path as a clipPath element.
    void replaceClip(xmlNode& element)
    {
        const auto clip = styles_.own(element, "clip-path");
        const auto shape = clip ? findFunction(clip->value, {std::begin(kShapes), std::end(kShapes)}) : std::nullopt;
        if (!shape) {
            return;
        }
        const std::string whole = lowered(clip->value);
        std::optional<Box> box;
        if (whole.find("view-box") != std::string::npos) {
            box = viewportOf(element);
        } else if (const auto boxes = boxesOf(element)) {
            const bool is_fill = whole.find("fill-box") != std::string::npos ||
                                 whole.find("content-box") != std::string::npos ||
                                 whole.find("padding-box") != std::string::npos;
            box = is_fill ? boxes->fill : boxes->stroke;
        }
        const std::string name = lowered(
            std::string_view(clip->value).substr(shape->begin, clip->value.find('(', shape->begin) - shape->begin));
        const auto path = box ? shapePath(name, shape->content, *box) : std::nullopt;
        if (!path) {
            note("the clip-path " + name + "() of this kind");
            return;
        }
        const std::string id = fmt::format("droplet-clip-{}", ++clips_);
        const auto* const clip_name = reinterpret_cast<const xmlChar*>("clipPath");
        xmlNode* const clip_path = xmlNewChild(&root_, root_.ns, clip_name, nullptr);
        setAttribute(*clip_path, "id", id);
        xmlNode* const outline = xmlNewChild(clip_path, root_.ns, reinterpret_cast<const xmlChar*>("path"), nullptr);
        setAttribute(*outline, "d", path->data);
        setProperty(*outline, "clip-rule", path->is_even_odd ? "evenodd" : "nonzero");
        set(element, "clip-path", "url(#" + id + ")");
    }

    struct ShapePath {
        std::string data;
        bool is_even_odd = false;
    };

    static std::string ellipsePath(double x, double y, double rx, double ry)
    {
        return fmt::format("M{:.10g},{:.10g}a{:.10g},{:.10g} 0 1 0 {:.10g},0a{:.10g},{:.10g} 0 1 0 {:.10g},0z", x - rx,
                           y, rx, ry, 2.0 * rx, rx, ry, -2.0 * rx);
    }

    static std::string boxPath(const Box& box, double radius)
    {
        const double r = std::clamp(radius, 0.0, 0.5 * std::min(box.width, box.height));
        const double w = box.width - 2.0 * r;
        const double h = box.height - 2.0 * r;
        if (r == 0.0) {
            return fmt::format("M{:.10g},{:.10g}h{:.10g}v{:.10g}h{:.10g}z", box.x, box.y, w, h, -w);
        }
        const auto arc = [&](double x, double y) {
            return fmt::format("a{:.10g},{:.10g} 0 0 1 {:.10g},{:.10g}", r, r, x, y);
        };
        return fmt::format("M{:.10g},{:.10g}h{:.10g}", box.x + r, box.y, w) + arc(r, r) + fmt::format("v{:.10g}", h) +
               arc(-r, r) + fmt::format("h{:.10g}", -w) + arc(-r, -r) + fmt::format("v{:.10g}", -h) + arc(r, -r) + "z";
    }

    /// Outline of a basic shape in a box; none if it is of a kind that is not read.
    static std::optional<ShapePath> shapePath(const std::string& name, std::string_view content, const Box& box)
    {
        if (name == "circle" || name == "ellipse") {
            return roundPath(name, content, box);
        }
        if (name == "polygon" || name == "path") {
            return drawnPath(name, content, box);
        }
        std::vector<std::string_view> words = partsOf(content, ',');
        double radius = 0.0;
        const auto round = std::find(words.begin(), words.end(), "round");
        if (round != words.end()) {
            const auto given = round + 2 == words.end() ? along(round[1], box.width) : std::nullopt;
            if (!given) {
                return std::nullopt;
            }
            radius = *given;
            words.erase(round, words.end());
        }
        if (words.empty() || words.size() > 4) {
            return std::nullopt;
        }
        // As of margins: one for all sides, or top and sides, …
        const std::string_view top = words[0];
        const std::string_view right = words.size() > 1 ? words[1] : top;
        const std::string_view bottom = words.size() > 2 ? words[2] : top;
        const std::string_view left = words.size() > 3 ? words[3] : right;
        const auto t = along(top, box.height);
        const auto r = along(right, box.width);
        const auto b = along(bottom, box.height);
        const auto l = along(left, box.width);
        if (!t || !r || !b || !l) {
            return std::nullopt;
        }
        Box inner{box.x + *l, box.y + *t, box.width - *l - *r, box.height - *t - *b};
        if (name == "rect") {
            inner = {box.x + *l, box.y + *t, *r - *l, *b - *t};
        } else if (name == "xywh") {  // words: x, y, width, height
            const auto x = along(words[0], box.width);
            const auto y = along(words[1], box.height);
            const auto w = words.size() == 4 ? along(words[2], box.width) : std::nullopt;
            const auto h = words.size() == 4 ? along(words[3], box.height) : std::nullopt;
            if (!x || !y || !w || !h) {
                return std::nullopt;
            }
            inner = {box.x + *x, box.y + *y, *w, *h};
        }
        inner.width = std::max(inner.width, 0.0);
        inner.height = std::max(inner.height, 0.0);
        return ShapePath{boxPath(inner, radius), false};
    }

    static std::optional<ShapePath> roundPath(const std::string& name, std::string_view content, const Box& box)
    {
        std::vector<std::string_view> words = partsOf(content, ',');
        const auto at = std::find(words.begin(), words.end(), "at");
        std::vector<std::string_view> place{"center", "center"};
        if (at != words.end()) {
            place.assign(at + 1, words.end());
            words.erase(at, words.end());
        }
        const auto centre = place.size() <= 2 ? placeIn(box, place) : std::nullopt;
        if (!centre || words.size() > (name == "circle" ? 1U : 2U)) {
            return std::nullopt;
        }
        const auto [x, y] = *centre;
        const double left = std::abs(x - box.x);
        const double right = std::abs(box.x + box.width - x);
        const double up = std::abs(y - box.y);
        const double down = std::abs(box.y + box.height - y);
        const auto radius = [&](std::string_view word, bool is_across, double whole) -> std::optional<double> {
            const bool is_circle = name == "circle";
            if (word == "closest-side") {
                return is_circle   ? std::min({left, right, up, down})
                       : is_across ? std::min(left, right)
                                   : std::min(up, down);
            }
            if (word == "farthest-side") {
                return is_circle   ? std::max({left, right, up, down})
                       : is_across ? std::max(left, right)
                                   : std::max(up, down);
            }
            return along(word, whole);
        };
        const std::string_view first = words.empty() ? "closest-side" : words[0];
        const std::string_view second = words.size() > 1 ? words[1] : "closest-side";
        if (name == "circle") {
            const auto r = radius(first, true, std::hypot(box.width, box.height) / std::sqrt(2.0));
            return r ? std::optional(ShapePath{ellipsePath(x, y, *r, *r), false}) : std::nullopt;
        }
        const auto rx = radius(first, true, box.width);
        const auto ry = radius(second, false, box.height);
        return rx && ry ? std::optional(ShapePath{ellipsePath(x, y, *rx, *ry), false}) : std::nullopt;
    }

    static std::optional<ShapePath> drawnPath(const std::string& name, std::string_view content, const Box& box)
    {
        ShapePath path;
        std::vector<std::string_view> words = partsOf(content, ',');
        if (!words.empty() && (words[0] == "evenodd" || words[0] == "nonzero")) {
            path.is_even_odd = words[0] == "evenodd";
            words.erase(words.begin());
        }
        if (name == "path") {
            // Paths are in pixels from the corner of the box; few boxes begin elsewhere than at the origin.
            if (words.size() != 1 || words[0].size() < 3 || box.x != 0.0 || box.y != 0.0) {
                return std::nullopt;
            }
            path.data = words[0].substr(1, words[0].size() - 2);
            return path;
        }
        for (std::size_t k = 0; k + 1 < words.size(); k += 2) {
            const auto x = along(words[k], box.width);
            const auto y = along(words[k + 1], box.height);
            if (!x || !y) {
                return std::nullopt;
            }
            path.data += fmt::format("{}{:.10g},{:.10g}", k == 0 ? "M" : "L", box.x + *x, box.y + *y);
        }
        return words.size() >= 6 && words.size() % 2 == 0 ? std::optional(path) : std::nullopt;
    }

    /// Map from an element's coordinates to the page, without places; none if it is not known.
    std::optional<Matrix> scaleOf(const xmlNode& element) const
    {
        Matrix whole;
        for (const xmlNode* here = &element; isElement(here); here = here->parent) {
            const auto own = transformOf(*here);
            const auto viewport = nameOf(*here) == "svg" ? viewportScale(*here) : Matrix{};
            if (!own || !viewport) {
                return std::nullopt;
            }
            whole = *own * *viewport * whole;
        }
        return whole;
    }

    /// Gives a stroke that does not scale the width that the scale makes right.
    void fixStroke(xmlNode& element)
    {
        const auto effect = styles_.own(element, "vector-effect");
        if (!effect || lowered(trimmed(effect->value)) == "none") {
            return;
        }
        const bool is_known = lowered(trimmed(effect->value)) == "non-scaling-stroke";
        const Matrix scale =
            (is_known ? scaleOf(element) : std::nullopt).value_or(Matrix{0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
        const double area = std::abs(scale.a * scale.d - scale.b * scale.c);
        constexpr double kRounding = 1e-6;
        const auto is_zero = [&](double value) { return std::abs(value) < kRounding * std::sqrt(area); };
        const bool is_even = area > 0.0 && ((is_zero(scale.a - scale.d) && is_zero(scale.b + scale.c)) ||
                                            (is_zero(scale.a + scale.d) && is_zero(scale.b - scale.c)));
        if (!is_even || isReferred(element)) {
            note("vector-effect of this kind, or under an uneven scale");
            return;
        }
        const double factor = 1.0 / std::sqrt(area);
        set(element, "vector-effect", "none");  // librsvg 2.60 knows it, too
        for (const char* name : {"stroke-width", "stroke-dasharray", "stroke-dashoffset"}) {
            const auto value = styles_.inherited(element, name);
            if (!value && std::strcmp(name, "stroke-width") != 0) {
                continue;
            }
            std::string result;
            for (const std::string_view part : partsOf(value ? std::string_view(value->value) : "1", ',')) {
                const auto length = parsePixels(part);
                if (!length) {
                    result.clear();
                    break;
                }
                result += fmt::format("{}{:.10g}", result.empty() ? "" : ",", factor * *length);
            }
            if (!result.empty()) {
                set(element, name, result);
            } else if (lowered(value->value) != "none") {
                note(std::string(name) + " of strokes that do not scale, in this unit");
            }
        }
    }

    /// Whether an element is drawn by reference, at a scale that depends on where.
    [[nodiscard]] bool isReferred(const xmlNode& element) const
    {
        static const std::set<std::string_view> referred{"defs", "symbol", "pattern", "marker", "mask", "clipPath"};
        for (const xmlNode* here = &element; isElement(here); here = here->parent) {
            if (referred.contains(nameOf(*here))) {
                return true;
            }
        }
        return false;
    }

    void noteMissing(const xmlNode& element)
    {
        static const std::map<std::string_view, const char*> known{{"textPath", "textPath (convert text to paths)"},
                                                                   {"flowRoot", "flowRoot (convert text to paths)"},
                                                                   {"foreignObject", "foreignObject"},
                                                                   {"meshgradient", "meshgradient"},
                                                                   {"hatch", "hatch"},
                                                                   {"animate", "animations"},
                                                                   {"animateTransform", "animations"},
                                                                   {"animateMotion", "animations"}};
        const std::string_view name = nameOf(element);
        const bool is_chosen = isElement(element.parent) && nameOf(*element.parent) == "switch";
        if (const auto lacking = known.find(name); lacking != known.end() && !is_chosen) {
            note(lacking->second);
        }
        const bool is_outside = refersOutside(element);
        if (is_outside && (name == "image" || name == "feImage")) {
            note("linked pictures (embed them)");
        } else if (is_outside && name == "use") {
            note("linked drawings (embed them)");
        }
        for (const char* property : {"fill", "stroke", "stop-color"}) {
            const auto value = styles_.own(element, property);
            const auto function = value ? findFunction(value->value, {"oklch", "oklab", "lab", "lch", "hwb", "color",
                                                                      "color-mix", "light-dark"})
                                        : std::nullopt;
            if (function) {
                note("the colour function " +
                     value->value.substr(function->begin, value->value.find('(', function->begin) - function->begin) +
                     "()");
            }
        }
        for (const char* property : {"offset-path", "mask-image"}) {
            if (const auto value = styles_.own(element, property); value && lowered(value->value) != "none") {
                note(property);
            }
        }
        if (name == "text") {
            noteMissingText(element);
        }
    }

    void noteMissingText(const xmlNode& element)
    {
        for (const char* property : {"shape-inside", "inline-size", "dominant-baseline", "textLength"}) {
            const auto value = styles_.inherited(element, property);
            if (value && lowered(value->value) != "auto" && lowered(value->value) != "none") {
                note(std::string(property) + " (convert text to paths)");
            }
        }
        static const std::set<std::string_view> generic{"serif",    "sans-serif",    "monospace",
                                                        "cursive",  "fantasy",       "system-ui",
                                                        "ui-serif", "ui-sans-serif", "ui-monospace"};
        const auto families = styles_.inherited(element, "font-family");
        if (!families || installedFonts().empty()) {
            return;
        }
        std::string first;
        for (const std::string& family : familiesIn(families->value)) {
            const bool is_generic = generic.contains(lowered(family));
            if (is_generic ? first.empty() : installedFonts().contains(lowered(family))) {
                return;
            }
            if (is_generic) {
                continue;  // what is used instead, as the drawing asks
            }
            first = first.empty() ? family : first;
        }
        if (!first.empty()) {
            const bool is_web = styles_.atRules().contains("@font-face");
            note("the " + std::string(is_web ? "web " : "") + "font '" + first +
                 "', for which another is used (install it, or convert text to paths)");
        }
    }

    xmlDoc* document_;
    xmlNode& root_;
    StyleSheets styles_;
    std::vector<xmlNode*> elements_;
    std::map<const xmlNode*, Matrix> placed_;  ///< transformations that were written anew
    std::set<std::string> in_rules_;           ///< properties that need a value in some rule
    std::vector<std::string> not_drawn_;
    std::size_t boxes_asked_ = 0;
    std::size_t clips_ = 0;
    bool is_changed_ = false;
};

}  // namespace

Rewritten rewritten(std::span<const std::byte> text)
{
    if (text.size() > kMaxText) {
        return {};
    }
    const DrawingTree document = parseDrawing(text);
    if (!document || xmlDocGetRootElement(document.get()) == nullptr) {
        return {};
    }
    return Rewriting(document.get()).run();
}

}  // namespace droplet
