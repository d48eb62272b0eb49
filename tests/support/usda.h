// SPDX-License-Identifier: GPL-3.0-or-later
// Reader of the part of USD's text format that the library writes; it refuses everything else.
// Pixar, "OpenUSD": "Crate and text file formats", pxr/usd/sdf/textFileFormat.
#pragma once

#include <algorithm>
#include <cctype>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace droplet::testing {

/// Attribute or relationship.
struct UsdProperty {
    std::string type;   ///< with its qualifiers, such as `uniform token`; `rel` for a relationship
    std::string value;  ///< as it is written; empty: none
    bool connects = false;
    std::map<std::string, std::string> metadata = {};
    std::map<double, std::string> samples = {};  ///< values by time code
};

/// Prim with its properties and children, both by name.
struct UsdPrim {
    std::string type;
    bool is_class = false;
    std::map<std::string, std::string> metadata;
    std::map<std::string, UsdProperty> properties;
    std::map<std::string, UsdPrim> children;
    std::vector<std::string> order;  ///< names of the children in the file

    [[nodiscard]] const UsdPrim& child(const std::string& name) const { return children.at(name); }
    [[nodiscard]] const std::string& value(const std::string& name) const { return properties.at(name).value; }
};

/// Numbers of a value, or of a list or tuples of them.
inline std::vector<double> numbersIn(std::string list)
{
    std::replace_if(
        list.begin(), list.end(), [](char c) { return std::string_view("[](),").find(c) != std::string_view::npos; },
        ' ');
    std::istringstream in(list);
    return {std::istream_iterator<double>(in), {}};
}

class UsdaReader {
public:
    explicit UsdaReader(std::string_view text) : text_(text) {}

    /// Root whose children are the prims of the file.
    UsdPrim read()
    {
        constexpr std::string_view kMagic = "#usda 1.0\n";
        require(text_.starts_with(kMagic), "the first line");
        at_ = kMagic.size();
        UsdPrim root;
        root.metadata = metadata();
        while (skip(), at_ < text_.size()) {
            prim(root);
        }
        return root;
    }

private:
    void require(bool holds, const std::string& what) const
    {
        if (!holds) {
            throw std::runtime_error("usda at byte " + std::to_string(at_) + ": " + what + ", not '" +
                                     std::string(text_.substr(at_, 30)) + "'");
        }
    }
    void skip()
    {
        while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
            ++at_;
        }
    }
    bool take(char c)
    {
        skip();
        const bool is_next = at_ < text_.size() && text_[at_] == c;
        at_ += is_next ? 1 : 0;
        return is_next;
    }
    void expect(char c) { require(take(c), std::string(1, c)); }

    std::string word(std::string_view others)
    {
        skip();
        const std::size_t begin = at_;
        while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 ||
                                      others.find(text_[at_]) != std::string_view::npos)) {
            ++at_;
        }
        require(at_ > begin, "a word");
        return std::string(text_.substr(begin, at_ - begin));
    }

    std::string quoted()
    {
        expect('"');
        std::string content;
        for (; require(at_ < text_.size() && text_[at_] != '\n', "a closing quote"), text_[at_] != '"'; ++at_) {
            at_ += text_[at_] == '\\' ? 1 : 0;
            content += text_[at_];
        }
        ++at_;
        return content;
    }

    /// Number, word, string, asset, path, or tuple or list of those.
    std::string value()
    {
        skip();
        const char first = at_ < text_.size() ? text_[at_] : ' ';
        if (first == '"') {
            return quoted();
        }
        if (first == '@' || first == '<') {
            const std::size_t end = text_.find(first == '@' ? '@' : '>', at_ + 1);
            require(end != std::string_view::npos, "a closing sign");
            const std::string content(text_.substr(at_ + 1, end - at_ - 1));
            at_ = end + 1;
            return content;
        }
        if (first != '(' && first != '[') {
            return word("+-._");
        }
        const char last = first == '(' ? ')' : ']';
        std::string content(1, first);
        ++at_;
        while (!take(last)) {
            if (content.size() > 1) {
                expect(',');
                content += ", ";
            }
            content += value();
        }
        return content + last;
    }

    std::map<double, std::string> samples()
    {
        std::map<double, std::string> all;
        expect('{');
        while (!take('}')) {
            if (!all.empty()) {
                expect(',');
            }
            const double code = std::stod(word("+-."));
            require(all.empty() || all.rbegin()->first < code, "time codes that ascend");
            expect(':');
            all.emplace(code, value());
        }
        return all;
    }

    std::map<std::string, std::string> metadata()
    {
        std::map<std::string, std::string> entries;
        if (take('(')) {
            while (!take(')')) {
                std::string key = word("_");
                if (key == "prepend") {
                    key += " " + word("_");
                }
                expect('=');
                require(entries.emplace(key, value()).second, "a key that is new");
            }
        }
        return entries;
    }

    void prim(UsdPrim& parent)
    {
        UsdPrim prim;
        const std::string specifier = word("");
        require(specifier == "def" || specifier == "class", "def or class");
        prim.is_class = specifier == "class";
        prim.type = word("");
        const std::string name = quoted();
        prim.metadata = metadata();
        expect('{');
        while (!take('}')) {
            if (text_.substr(at_, 4) == "def " || text_.substr(at_, 6) == "class ") {
                this->prim(prim);
            } else {
                property(prim);
            }
        }
        parent.order.push_back(name);
        require(parent.children.emplace(name, std::move(prim)).second, "a prim's name that is new: " + name);
    }

    void property(UsdPrim& prim)
    {
        UsdProperty property;
        property.type = word("");
        while (property.type == "custom" || property.type == "uniform" || property.type.ends_with(" uniform")) {
            property.type += " " + word("");
        }
        if (take('[')) {
            expect(']');
            property.type += "[]";
        }
        std::string name = word("_:.");
        if (constexpr std::string_view kConnect = ".connect"; name.ends_with(kConnect)) {
            name.resize(name.size() - kConnect.size());
            property.connects = true;
        }
        if (constexpr std::string_view kSamples = ".timeSamples"; name.ends_with(kSamples)) {
            name.resize(name.size() - kSamples.size());
            expect('=');
            property.samples = samples();
            // An attribute may be declared before its samples.
            if (const auto declared = prim.properties.find(name); declared != prim.properties.end()) {
                require(declared->second.value.empty(), "samples of an attribute without a value");
                property.metadata = declared->second.metadata;
                prim.properties.erase(declared);
            }
        } else if (take('=')) {
            property.value = value();
        }
        property.metadata.merge(metadata());
        require(prim.properties.emplace(name, std::move(property)).second, "a property's name that is new: " + name);
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

}  // namespace droplet::testing
