// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__AVX2__) || defined(__AVX512F__)
#include <immintrin.h>
#endif

/// Vectors of doubles, a lane a particle. With one lane a vector is a double: the same source, the oracle of
/// the others.
namespace tripoint {

/// The vector unit that a file is compiled for. It is part of the type of everything that is compiled for
/// several units, so that the linker never mixes them up. In code compiled for any machine it is `Any`.
#ifndef TRIPOINT_UNIT
#define TRIPOINT_UNIT Any
#define TRIPOINT_UNIT_LANES 1
#endif
struct Any;
struct Avx2;
struct Avx512;
using Unit = TRIPOINT_UNIT;

template <int L>
struct Lanes {
  typedef double Real __attribute__((vector_size(8 * L)));
  typedef long Mask __attribute__((vector_size(8 * L)));  ///< all bits of a lane set, or none
};
template <>
struct Lanes<1> {
  using Real = double;
  using Mask = bool;
};

template <int L>
[[nodiscard, gnu::always_inline]] inline typename Lanes<L>::Real load_lanes(const double* from) noexcept {
  typename Lanes<L>::Real v;
  std::memcpy(&v, from, sizeof v);
  return v;
}

/// Square root of each lane, rounded as IEEE asks.
template <class V>
[[nodiscard, gnu::always_inline]] inline V root(V v) noexcept {
  if constexpr (sizeof(V) == sizeof(double)) {
    return std::sqrt(v);
#ifdef __AVX512F__
  } else if constexpr (sizeof(V) == 64) {
    return reinterpret_cast<V>(_mm512_sqrt_pd(reinterpret_cast<__m512d>(v)));
#endif
#ifdef __AVX2__
  } else if constexpr (sizeof(V) == 32) {
    return reinterpret_cast<V>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(v)));
#endif
  } else {
    for (std::size_t l = 0; l < sizeof(V) / sizeof(double); ++l) v[l] = std::sqrt(v[l]);
    return v;
  }
}

/// Lane l where bit l is set.
template <int L>
[[nodiscard, gnu::always_inline]] inline typename Lanes<L>::Mask mask_of(unsigned bits) noexcept {
  if constexpr (L == 1) {
    return (bits & 1u) != 0;
  } else {
    typename Lanes<L>::Mask power;
    for (int l = 0; l < L; ++l) power[l] = 1L << l;
    return (power & static_cast<long>(bits)) == power;
  }
}

/// Bit l where lane l is set.
template <int L>
[[nodiscard, gnu::always_inline]] inline unsigned bits_of(typename Lanes<L>::Mask mask) noexcept {
  if constexpr (L == 1) {
    return mask ? 1u : 0u;
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  } else if constexpr (L == 8) {
    return static_cast<unsigned>(_mm512_movepi64_mask(reinterpret_cast<__m512i>(mask)));
#endif
#ifdef __AVX2__
  } else if constexpr (L == 4) {
    return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(mask)));
#endif
  } else {
    unsigned bits = 0;
    for (int l = 0; l < L; ++l) bits |= mask[l] != 0 ? 1u << l : 0u;
    return bits;
  }
}

/// Result of a comparison of such vectors: a mask, or a bool for one lane.
template <class V>
using MaskOf = typename Lanes<static_cast<int>(sizeof(V) / sizeof(double))>::Mask;

/// Whether any lane is set.
[[nodiscard, gnu::always_inline]] inline bool any(bool mask) noexcept { return mask; }
template <class Mask>
requires(sizeof(Mask) > sizeof(long)) [[nodiscard, gnu::always_inline]] inline bool any(Mask mask) noexcept {
  return bits_of<static_cast<int>(sizeof(Mask) / sizeof(long))>(mask) != 0;
}

/// Bit l where lane l is less than the bound.
template <class V>
[[nodiscard, gnu::always_inline]] inline unsigned bits_below(V v, double bound) noexcept {
#ifdef __AVX512F__
  if constexpr (sizeof(V) == 64)
    return _mm512_cmp_pd_mask(reinterpret_cast<__m512d>(v), _mm512_set1_pd(bound), _CMP_LT_OS);
#endif
  return bits_of<static_cast<int>(sizeof(V) / sizeof(double))>(v < bound);
}

/// Bit n where byte n of 64 is not 0.
[[nodiscard, gnu::always_inline]] inline std::uint64_t bits_of_bytes(const std::uint8_t* bytes) noexcept {
#ifdef __AVX2__
  const auto zeros = [&](int half) {
    const __m256i some = _mm256_load_si256(reinterpret_cast<const __m256i*>(bytes) + half);
    return static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(some, _mm256_setzero_si256())));
  };
  return ~(static_cast<std::uint64_t>(zeros(1)) << 32 | zeros(0));
#else
  std::uint64_t bits = 0;
  for (unsigned n = 0; n < 64; ++n) bits |= static_cast<std::uint64_t>(bytes[n] != 0) << n;
  return bits;
#endif
}

/// v where the lane is set, else 0: nothing is multiplied.
template <class V>
[[nodiscard, gnu::always_inline]] inline V where(MaskOf<V> mask, V v) noexcept {
  return mask ? v : V{};
}

/// The same number in each lane.
template <class V>
[[nodiscard, gnu::always_inline]] inline V every_lane(double value) noexcept {
  return value - V{};  // -0 and values that are not finite keep their bits
}

/// 2ab/(a + b) of numbers that are not negative. Where both are equal it is they themselves, to the bit;
/// where they are in every lane nothing is divided.
template <class V>
[[nodiscard, gnu::always_inline]] inline V harmonic_mean(V a, V b) noexcept {
  const MaskOf<V> differ = a != b;
  if (!any(differ)) return b;
  const V mean = 2.0 * a * b / (a + b);
  return differ ? mean : b;
}

}  // namespace tripoint
