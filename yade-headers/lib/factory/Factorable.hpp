// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: Factorable is 24 bytes (vptr, then boost::enable_shared_from_this at 8); slots D1, D0,
// getBaseClassName, getBaseClassNumber, getClassName. A class names its bases as one word list. Verified:
// relocations of the vtable in the installed libraries, tests/abi.
#pragma once

#include <lib/base/Math.hpp>
#include <lib/factory/ClassFactory.hpp>

#include <boost/enable_shared_from_this.hpp>
#include <sstream>

namespace yade {

class Factorable : public boost::enable_shared_from_this<Factorable> {
public:
    Factorable() {}
    virtual ~Factorable();
    virtual string getBaseClassName(unsigned int = 0) const;
    virtual int getBaseClassNumber() const;
    virtual string getClassName() const;
};

namespace abi {
/// Words of a base list such as "Functor FunctorWrapper".
inline vector<string> words(const char* list) {
    std::istringstream stream(list);
    vector<string> found;
    for (string word; stream >> word;)
        found.push_back(word);
    return found;
}
inline string word(const char* list, unsigned ordinal) {
    const vector<string> all = words(list);
    return ordinal < all.size() ? all[ordinal] : string();
}
} // namespace abi

} // namespace yade

#define REGISTER_CLASS_NAME(klass)                                                                           \
public:                                                                                                      \
    std::string getClassName() const override {                                                              \
        return #klass;                                                                                       \
    }

#define REGISTER_BASE_CLASS_NAME(bases)                                                                      \
public:                                                                                                      \
    std::string getBaseClassName(unsigned int ordinal = 0) const override {                                  \
        return ::yade::abi::word(#bases, ordinal);                                                           \
    }                                                                                                        \
    int getBaseClassNumber() const override {                                                                \
        return int(::yade::abi::words(#bases).size());                                                       \
    }

#define REGISTER_CLASS_AND_BASE(klass, bases)                                                                \
    REGISTER_CLASS_NAME(klass)                                                                               \
    REGISTER_BASE_CLASS_NAME(bases)
