// SPDX-License-Identifier: GPL-3.0-or-later
// No file lies behind /proc here.
#pragma once

#define PROC_SUPER_MAGIC 0x9fa0
