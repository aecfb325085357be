// The compilers' wide numbers, declared so that -Wpedantic accepts them.
#pragma once

namespace plumbline::exact {

__extension__ typedef __int128 Int128;
__extension__ typedef __float128 Float128;  ///< 113 bits of mantissa

}  // namespace plumbline::exact
