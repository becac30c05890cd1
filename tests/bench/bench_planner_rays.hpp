#pragma once

namespace vantage::bench {

/// Rows for the rays alone: how many a second, and how many bare Embree calls trace of the same.
void add_ray_rows();

}  // namespace vantage::bench
