// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "mask/segmentation.h"

namespace droplet {

/// Levels of a plane as numbers from 0 to 1, scaled down so that its longer side has at most `longest` pixels.
cv::Mat workingImage(const LevelView& plane, int longest = 1024);

/// Median level of an image in a region; 0 if that is empty.
/// @param region  255 or 0
double medianLevel(const cv::Mat& image, const cv::Mat& region);

/// Smallest and largest level of an image within a distance of each pixel.
struct LocalRange {
    cv::Mat min;
    cv::Mat max;
};

LocalRange localRange(const cv::Mat& image, int reach);

/// Merges regions, liquid or dry, with their surroundings if less than half of their rim lies at an edge, or if they
/// have fewer pixels than `min_area`. The largest region of each kind stays. Liquid is 8-connected, dry 4-connected.
/// @param is_liquid  255 or 0; changed
/// @param is_edge    255 or 0
void dropRegionsWithoutEdge(cv::Mat& is_liquid, const cv::Mat& is_edge, int min_area);

}  // namespace droplet
