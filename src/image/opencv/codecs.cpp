// SPDX-License-Identifier: GPL-3.0-or-later
//
// Module that decodes images, and encodes OpenEXR, with OpenCV's imgcodecs. It loads over a hundred libraries, so it is
// opened only when a file needs it.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iostream>
#include <limits>
#include <memory>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <streambuf>
#include <string>
#include <vector>

#include "image/codec_module.h"

namespace {

struct TooLarge {
    int width = 0;
    int height = 0;
};

/// Decoding on a thread: the size limit, and OpenCV's messages.
struct Decoding {
    std::size_t max_pixels = 0;
    std::string messages;
};

thread_local Decoding* decoding = nullptr;

/// Rejects an image that is too large at the moment when OpenCV, having read the header, allocates its memory.
class SizeLimitAllocator : public cv::MatAllocator {
public:
    explicit SizeLimitAllocator(const cv::MatAllocator* allocator) : allocator_(allocator) {}

    cv::UMatData* allocate(int dimensions, const int* sizes, int type, void* data, std::size_t* step,
                           cv::AccessFlag flags, cv::UMatUsageFlags usage) const override
    {
        if (decoding != nullptr && dimensions == 2 && sizes[0] > 0 && sizes[1] > 0 &&
            static_cast<std::size_t>(sizes[1]) > decoding->max_pixels / static_cast<std::size_t>(sizes[0])) {
            throw TooLarge{sizes[1], sizes[0]};
        }
        return allocator_->allocate(dimensions, sizes, type, data, step, flags, usage);
    }
    bool allocate(cv::UMatData* data, cv::AccessFlag flags, cv::UMatUsageFlags usage) const override
    {
        return allocator_->allocate(data, flags, usage);
    }
    void deallocate(cv::UMatData* data) const override { allocator_->deallocate(data); }

private:
    const cv::MatAllocator* allocator_;
};

/// Captures what OpenCV prints to std::cerr about a file; other threads' output passes.
class MessageCapture : public std::streambuf {
public:
    explicit MessageCapture(std::streambuf* out) : out_(out) {}

protected:
    int_type overflow(int_type c) override
    {
        if (traits_type::eq_int_type(c, traits_type::eof())) {
            return traits_type::not_eof(c);
        }
        if (decoding == nullptr) {
            return out_->sputc(traits_type::to_char_type(c));
        }
        decoding->messages += traits_type::to_char_type(c);
        return c;
    }
    std::streamsize xsputn(const char* text, std::streamsize count) override
    {
        if (decoding == nullptr) {
            return out_->sputn(text, count);
        }
        decoding->messages.append(text, static_cast<std::size_t>(count));
        return count;
    }
    int sync() override { return decoding == nullptr ? out_->pubsync() : 0; }

private:
    std::streambuf* out_;
};

/// Installs both. They stay until the end of the process.
bool install()
{
    static auto* const allocator = new SizeLimitAllocator(cv::Mat::getDefaultAllocator());
    static auto* const capture = new MessageCapture(std::cerr.rdbuf());
    cv::Mat::setDefaultAllocator(allocator);
    std::cerr.rdbuf(capture);
    return true;
}

/// Extracts the reason from an OpenCV message. Its forms are "…: error: (-2:Unspecified error) the reason in function
/// 'name'" and "… error) in function 'name'", a line end, "> the reason:".
std::string reasonIn(const std::string& messages)
{
    const auto error = messages.rfind("error: (");
    auto begin = error == std::string::npos ? error : messages.find(") ", error);
    if (begin == std::string::npos) {
        return "";
    }
    begin += 2;
    if (messages.compare(begin, 11, "in function") == 0) {
        begin = messages.find("> ", begin);
        begin = begin == std::string::npos ? messages.size() : begin + 2;
    }
    const std::string reason = messages.substr(
        begin, std::min({messages.find(" in function", begin), messages.find('\n', begin), messages.size()}) - begin);
    return reason.find("CV_IO_MAX_IMAGE") == std::string::npos ? reason : "over 2^20 pixels a side or 2^30 in all";
}

DropletOutcome damaged(DropletPicture& picture, const std::string& reason)
{
    picture.problem[reason.copy(picture.problem, sizeof picture.problem - 1)] = '\0';
    return DropletOutcome::Damaged;
}

int bitsOf(const cv::Mat& image)
{
    switch (image.depth()) {
        case CV_8U:
            return 8;
        case CV_16U:
            return 16;
        case CV_32F:
            return 32;
        case CV_64F:
            return 64;
        default:
            return 0;
    }
}

DropletOutcome decode(const cv::Mat& encoded, Decoding& here, DropletPicture& picture)
{
    try {
        auto image = std::make_unique<cv::Mat>(cv::imdecode(encoded, cv::IMREAD_UNCHANGED));
        if (image->empty() || !image->isContinuous()) {
            return damaged(picture, reasonIn(here.messages));
        }
        picture = {image->cols, image->rows, image->channels(), bitsOf(*image), image->data, nullptr, ""};
        picture.owner = image.release();
        return DropletOutcome::Decoded;
    } catch (const TooLarge& size) {
        picture.width = size.width;
        picture.height = size.height;
        return DropletOutcome::TooLarge;
    } catch (const cv::Exception& error) {
        return error.code == cv::Error::StsNoMem ? DropletOutcome::OutOfMemory
                                                 : damaged(picture, reasonIn(error.what()));
    } catch (const std::bad_alloc&) {
        return DropletOutcome::OutOfMemory;
    } catch (const std::exception&) {
        return damaged(picture, reasonIn(here.messages));
    }
}

struct Floats {
    const float* values = nullptr;
    int width = 0;
    int height = 0;
    int channels = 0;
};

DropletOutcome encodeExr(const Floats& floats, const Decoding& here, DropletPicture& picture)
{
    try {
        cv::Mat image(floats.height, floats.width, CV_32FC(floats.channels), const_cast<float*>(floats.values));
        if (floats.channels == 3) {
            const cv::Mat red_first = image;
            image = cv::Mat(floats.height, floats.width, CV_32FC3);
            for (int y = 0; y < floats.height; ++y) {
                const auto* const from = red_first.ptr<cv::Vec3f>(y);
                auto* const to = image.ptr<cv::Vec3f>(y);
                for (int x = 0; x < floats.width; ++x) {
                    to[x] = {from[x][2], from[x][1], from[x][0]};
                }
            }
        }
        std::vector<std::uint8_t> bytes;
        if (!cv::imencode(".exr", image, bytes, {cv::IMWRITE_EXR_TYPE, cv::IMWRITE_EXR_TYPE_FLOAT}) || bytes.empty()) {
            return damaged(picture, reasonIn(here.messages));
        }
        auto file = std::make_unique<cv::Mat>(1, static_cast<int>(bytes.size()), CV_8UC1);
        std::copy(bytes.begin(), bytes.end(), file->data);
        picture.width = file->cols;
        picture.height = 1;
        picture.channels = 1;
        picture.bits = 8;
        picture.pixels = file->data;
        picture.owner = file.release();
        return DropletOutcome::Decoded;
    } catch (const std::bad_alloc&) {
        return DropletOutcome::OutOfMemory;
    } catch (const std::exception& error) {
        return damaged(picture, reasonIn(error.what()));
    }
}

}  // namespace

extern "C" {

DropletOutcome dropletDecode(const void* encoded, std::size_t size, std::size_t max_pixels, DropletPicture* picture)
{
    static const bool installed = install();
    *picture = {};
    if (!installed || size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
        return damaged(*picture, "it is a file of 2 GiB or more");
    }
    Decoding here{max_pixels, {}};
    // OpenCV only reads; its interface requires the const_cast.
    const cv::Mat bytes(1, static_cast<int>(size), CV_8UC1, const_cast<void*>(encoded));
    decoding = &here;
    const DropletOutcome outcome = decode(bytes, here, *picture);
    decoding = nullptr;
    return outcome;
}

DropletOutcome dropletEncodeExr(const float* values, int width, int height, int channels, DropletPicture* picture)
{
    static const bool installed = install();
    *picture = {};
    Decoding here{std::numeric_limits<std::size_t>::max(), {}};
    decoding = installed ? &here : nullptr;
    const DropletOutcome outcome = encodeExr({values, width, height, channels}, here, *picture);
    decoding = nullptr;
    return outcome;
}

void dropletRelease(DropletPicture* picture)
{
    delete static_cast<cv::Mat*>(picture->owner);
}
}
