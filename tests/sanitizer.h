// Sanitizer with which the tests are built.
#pragma once

namespace plumbline {

#ifdef __has_feature  // clang
inline constexpr bool kAddressSanitizer = __has_feature(address_sanitizer);
#elif defined(__SANITIZE_ADDRESS__)
inline constexpr bool kAddressSanitizer = true;
#else
inline constexpr bool kAddressSanitizer = false;
#endif

}  // namespace plumbline
