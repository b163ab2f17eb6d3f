// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: the installed libraries hold Boost's serializers of their own classes and of the Eigen types, for
// the archives xml and binary; a class is exported under the name yade::<Class>. Verified: symbols of
// libyade.so, libpkg_common.so, libpkg_dem.so; files exchanged with YADE in tests/abi. Because the code is
// taken from there, no serialize() of a stock class is needed here and archives are the same in both
// directions.
#pragma once

#include <lib/factory/ClassFactory.hpp>

#define YADE_ABI_VALUE_SERIALIZERS(...)                                                                      \
    namespace boost::archive::detail {                                                                       \
    extern template class oserializer<boost::archive::xml_oarchive, __VA_ARGS__>;                            \
    extern template class oserializer<boost::archive::binary_oarchive, __VA_ARGS__>;                         \
    extern template class iserializer<boost::archive::xml_iarchive, __VA_ARGS__>;                            \
    extern template class iserializer<boost::archive::binary_iarchive, __VA_ARGS__>;                         \
    }

// The serializers of pointers are made here where needed: their constructors are not exported, and they only
// forward to the ones above.
#define YADE_ABI_STOCK_SERIALIZERS(klass)                                                                    \
    BOOST_CLASS_EXPORT_KEY(yade::klass)                                                                      \
    YADE_ABI_VALUE_SERIALIZERS(yade::klass)

YADE_ABI_VALUE_SERIALIZERS(yade::Vector2r)
YADE_ABI_VALUE_SERIALIZERS(yade::Vector3r)
YADE_ABI_VALUE_SERIALIZERS(yade::Vector3i)
YADE_ABI_VALUE_SERIALIZERS(yade::Quaternionr)
YADE_ABI_VALUE_SERIALIZERS(yade::Matrix3r)
YADE_ABI_VALUE_SERIALIZERS(yade::Se3r)
YADE_ABI_VALUE_SERIALIZERS(std::vector<yade::Vector2r>)
YADE_ABI_VALUE_SERIALIZERS(std::vector<yade::Vector3r>)
