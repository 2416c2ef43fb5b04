#pragma once

/// The kinds of ResidentMesh for which its kernels are compiled: INSTANTIATE(T, layout, Slot) for each.
#define TRISMOOTH_FOR_RESIDENT_MESHES(INSTANTIATE) \
  INSTANTIATE(float, Layout::aos, std::int16_t);   \
  INSTANTIATE(float, Layout::aos, std::int32_t);   \
  INSTANTIATE(float, Layout::soa, std::int16_t);   \
  INSTANTIATE(float, Layout::soa, std::int32_t);   \
  INSTANTIATE(double, Layout::aos, std::int16_t);  \
  INSTANTIATE(double, Layout::aos, std::int32_t);  \
  INSTANTIATE(double, Layout::soa, std::int16_t);  \
  INSTANTIATE(double, Layout::soa, std::int32_t)
