#pragma once

/// Marks what a vantage library exports; everything else stays hidden inside it.
#define VANTAGE_API __attribute__((visibility("default")))
