// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/curved_geometry.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/fe/mapping_q_cache.h>

#include <algorithm>
#include <utility>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    using CoarseCell = types::coarse_cell_id;

    /// deal.II's own takes the nodes from manifolds, which meshes of simplices do not
    /// have inside; here they are given.
    template <int dim>
    class GivenNodes : public MappingFE<dim>
    {
    public:
      using Nodes = std::map<CoarseCell, std::vector<Point<dim>>>;

      GivenNodes(const FiniteElement<dim>           &element,
                 const std::shared_ptr<const Nodes> &nodes)
        : MappingFE<dim>(element)
        , nodes(nodes)
      {}

      std::unique_ptr<Mapping<dim>>
      clone() const override
      {
        return std::make_unique<GivenNodes<dim>>(*this->fe, nodes);
      }

    protected:
      std::vector<Point<dim>>
      compute_mapping_support_points(
        const typename Triangulation<dim>::cell_iterator &cell) const override
      {
        return nodes->at(cell->id().get_coarse_cell_id());
      }

    private:
      const std::shared_ptr<const Nodes> nodes;
    };



    /// Numbers of the vertices of @p object, a line, face or cell.
    template <typename Object>
    std::vector<unsigned int>
    sorted_vertices(const Object &object)
    {
      std::vector<unsigned int> vertices;
      for (const unsigned int v : object->vertex_indices())
        vertices.push_back(object->vertex_index(v));
      std::sort(vertices.begin(), vertices.end());
      return vertices;
    }



    /// Only the nodes of this rank's part of the mesh are kept, also on the
    /// first rank.
    template <int dim>
    typename GivenNodes<dim>::Nodes
    distribute(const CellNodes<dim>     &of_first_rank,
               const Triangulation<dim> &triangulation,
               const MPI_Comm            communicator)
    {
      const CellNodes<dim> all =
        Utilities::MPI::broadcast(communicator, of_first_rank, 0);
      typename GivenNodes<dim>::Nodes mine;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (!cell->is_artificial())
          {
            const CoarseCell id = cell->id().get_coarse_cell_id();
            mine[id]            = all.at(id);
          }
      return mine;
    }
  } // namespace



  template <int dim>
  CellNodes<dim>
  collect_cell_nodes(const Triangulation<dim> &triangulation,
                     const NodesBetween<dim>  &between)
  {
    CellNodes<dim> nodes;
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        std::vector<Point<dim>> own;
        for (const unsigned int v : cell->vertex_indices())
          own.push_back(cell->vertex(v));
        for (const unsigned int l : cell->line_indices())
          own.push_back(between.at(sorted_vertices(cell->line(l))));
        if (cell->reference_cell().is_hyper_cube())
          {
            if constexpr (dim == 3)
              for (const auto &face : cell->face_iterators())
                own.push_back(between.at(sorted_vertices(face)));
            own.push_back(between.at(sorted_vertices(cell)));
          }
        nodes.push_back(std::move(own));
      }
    return nodes;
  }



  template <int dim>
  std::unique_ptr<Mapping<dim>>
  make_curved_geometry(const CellNodes<dim>     &of_first_rank,
                       const Triangulation<dim> &triangulation,
                       const MPI_Comm            communicator)
  {
    const auto nodes = std::make_shared<const typename GivenNodes<dim>::Nodes>(
      distribute(of_first_rank, triangulation, communicator));
    if (triangulation.all_reference_cells_are_hyper_cube())
      return std::make_unique<GivenNodes<dim>>(FE_Q<dim>(2), nodes);
    return std::make_unique<GivenNodes<dim>>(FE_SimplexP<dim>(2), nodes);
  }



  template <int dim>
  std::unique_ptr<Mapping<dim>>
  make_curved_geometry(const Triangulation<dim> &triangulation)
  {
    auto geometry = std::make_unique<MappingQCache<dim>>(2);
    geometry->initialize(MappingQ<dim>(2), triangulation);
    return geometry;
  }


  template CellNodes<2>
  collect_cell_nodes(const Triangulation<2> &, const NodesBetween<2> &);
  template CellNodes<3>
  collect_cell_nodes(const Triangulation<3> &, const NodesBetween<3> &);
  template std::unique_ptr<Mapping<2>>
  make_curved_geometry(const CellNodes<2> &,
                       const Triangulation<2> &,
                       const MPI_Comm);
  template std::unique_ptr<Mapping<3>>
  make_curved_geometry(const CellNodes<3> &,
                       const Triangulation<3> &,
                       const MPI_Comm);
  template std::unique_ptr<Mapping<2>>
  make_curved_geometry(const Triangulation<2> &);
  template std::unique_ptr<Mapping<3>>
  make_curved_geometry(const Triangulation<3> &);
} // namespace Ricochet
