// SPDX-License-Identifier: GPL-2.0-or-later
// Facts: registerFactorable and registerPluginClasses are exported; the list of plugin classes stands at
// offset 144 (dynamic-library manager 88 bytes at 8, map of creators 48 bytes at 96). YADE reads the archives
// xml and binary, so a class is exported to these four. Verified: symbols of libyade.so, tests/abi.
#pragma once

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/xml_iarchive.hpp>
#include <boost/archive/xml_oarchive.hpp>
#include <boost/serialization/export.hpp> // after the archives it exports to
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/shared_ptr.hpp>
#include <boost/serialization/vector.hpp>

#include <lib/base/Math.hpp>
#include <lib/base/Singleton.hpp>

#include <boost/preprocessor.hpp>
#include <list>

namespace yade {

class Factorable;

class ClassFactory : public Singleton<ClassFactory> {
public:
    using CreateShared = shared_ptr<Factorable> (*)();
    using Create = Factorable* (*)();
    using CreateOpaque = void* (*)();

    bool registerFactorable(string name, Create, CreateShared, CreateOpaque);
    /// Takes {file, class, class, ..., nullptr}.
    void registerPluginClasses(const char* fileAndClasses[]);
    shared_ptr<Factorable> createShared(string name);

private:
    virtual ~ClassFactory();
    virtual string getClassName() const;
    virtual string getBaseClassName(int) const;

    unsigned char libraryManager_[88];
    unsigned char creators_[48];

public:
    std::list<string> pluginClasses;
};

namespace abi {
template <class T>
shared_ptr<Factorable> createShared() {
    return shared_ptr<Factorable>(new T);
}
// The factory's interface: it owns what these return.
template <class T>
Factorable* create() {
    return new T;
}
template <class T>
void* createOpaque() {
    return new T;
}

template <class... Classes, class... Names>
bool announcePlugin(const char* file, Names... names) {
    (ClassFactory::instance().registerFactorable(names, &create<Classes>, &createShared<Classes>,
                                                 &createOpaque<Classes>),
     ...);
    const char* list[] = {file, names..., nullptr};
    ClassFactory::instance().registerPluginClasses(list);
    return true;
}
} // namespace abi

} // namespace yade

#define YADE_ABI_QUOTED(r, data, klass) , BOOST_PP_STRINGIZE(klass)
#define YADE_ABI_EXPORT(r, data, klass) BOOST_CLASS_EXPORT_IMPLEMENT(yade::klass)
#define YADE_ABI_PYTHON(r, data, klass)                                                                      \
    void klass::pySetAttr(const std::string& key, const boost::python::object& value) {                      \
        if (!::yade::abi::setAttribute(*this, key, value))                                                   \
            AbiBase::pySetAttr(key, value);                                                                  \
    }                                                                                                        \
    boost::python::dict klass::pyDict() const {                                                              \
        return ::yade::abi::attributeDict(*this, this->pyDictCustom(), AbiBase::pyDict());                   \
    }                                                                                                        \
    void klass::pyRegisterClass(boost::python::object scope) {                                               \
        registerInPython(scope);                                                                             \
    }

// Stands inside namespace yade, which it closes and opens again because Boost's export macro opens its own.
// Each class that uses a class macro needs it in exactly one source file.
#define YADE_PLUGIN(classes)                                                                                 \
    BOOST_PP_SEQ_FOR_EACH(YADE_ABI_PYTHON, ~, classes)                                                       \
    namespace {                                                                                              \
    const bool BOOST_PP_CAT(pluginWith, BOOST_PP_SEQ_HEAD(classes)) =                                        \
        ::yade::abi::announcePlugin<BOOST_PP_SEQ_ENUM(classes)>(                                             \
            __FILE__ BOOST_PP_SEQ_FOR_EACH(YADE_ABI_QUOTED, ~, classes));                                    \
    }                                                                                                        \
    }                                                                                                        \
    BOOST_PP_SEQ_FOR_EACH(YADE_ABI_EXPORT, ~, classes)                                                       \
    namespace yade {
