// SPDX-License-Identifier: GPL-3.0-or-later
#include "droplet/compensated_sum.h"

#include <cmath>

namespace droplet {

void CompensatedSum::add(double term)
{
    const double total = sum + term;
    carry += std::abs(sum) >= std::abs(term) ? (sum - total) + term : (term - total) + sum;
    sum = total;
}

}  // namespace droplet
