// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene_file.hpp"

#include <core/Omega.hpp>
#include <core/Scene.hpp>

#include <boost/serialization/nvp.hpp>
#include <boost/serialization/shared_ptr.hpp>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace grainfall {

namespace {

/// The scene without some of its engines, as long as this lives.
class WithoutEngines {
public:
    WithoutEngines(yade::Scene& scene, const std::vector<std::string>& classes)
        : scene_(scene), all_(scene.engines) {
        const auto named = [&classes](const auto& engine) {
            return std::find(classes.begin(), classes.end(), engine->getClassName()) != classes.end();
        };
        scene.engines.erase(std::remove_if(scene.engines.begin(), scene.engines.end(), named),
                            scene.engines.end());
    }
    ~WithoutEngines() { scene_.engines.swap(all_); }
    WithoutEngines(const WithoutEngines&) = delete;

private:
    yade::Scene& scene_;
    std::vector<boost::shared_ptr<yade::Engine>> all_;
};

} // namespace

void write_scene(const std::string& path, const std::vector<std::string>& left_out) {
    std::ofstream file(path, std::ios::binary);
    if (!file)
        throw std::runtime_error("cannot write " + path);
    {
        const boost::shared_ptr<yade::Scene> scene = yade::Omega::instance().getScene();
        const WithoutEngines fewer(*scene, left_out);
        boost::archive::binary_oarchive archive(file);
        archive << boost::serialization::make_nvp("scene", scene);
    }
    file.close();
    if (!file)
        throw std::runtime_error("cannot write " + path + ": disk full?");
}

} // namespace grainfall
