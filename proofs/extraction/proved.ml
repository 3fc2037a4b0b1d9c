(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* dyadel-proved FILE: checks a certificate by the checker that is proved in Coq (theories/Checker.v, CheckerFaces.v), and
   says what of it is proved by it and what is not, as `dyadel verify` does. Exit status 0: everything that is stated is
   proved; 3: accepted, but something is not proved, and named; 1: rejected. "-" is standard input. *)
open Reader

let whole_file name =
  let channel = if name = "-" then stdin else open_in_bin name in
  let text = Buffer.create 65536 in
  let rec fill () = match Buffer.add_channel text channel 65536 with () -> fill () | exception End_of_file -> () in
  fill ();
  close_in channel;
  Buffer.contents text

(* The line of the first pair whose point is no witness; that of the first pair when the sites are at fault. *)
let line_at_fault c d e =
  match Checker.scaled_sites d e c.sites with
  | None -> c.first_edge - 1
  | Some boxes ->
    let good = Checker.check_edge d e (Checker.index (fun b -> b.Checker.box_name) boxes) (Checker.build Checker.deepest boxes) in
    let rec first k = function [] -> c.first_edge - 1 | edge :: rest -> if good edge then first (k + 1) rest else k in
    first c.first_edge c.edges

(* How many sites are not surrounded, 0 when no pair is left over; how many triangles there are to surround them. *)
let left_over c d e =
  let boxes = Option.get (Checker.scaled_sites d e c.sites) in
  let triangles, fans = Hints.triangles_and_fans boxes c.edges in
  let found = Checker.surrounded d e c.sites c.edges triangles c.corners fans in
  let left = if Checker.all_surrounded c.sites c.edges found then 0 else List.length c.sites - List.length found in
  (left, List.length triangles)

(* Does the bound that the goal is about reach it? *)
let is_reached c =
  let reaches m = function
    | Some (n : Checker.number) ->
      (* the least k such that man <= 2^k; man is positive *)
      let k = Z.numbits (Z.pred n.man) in
      Z.sign n.man <= 0 || Z.leq (Z.add (Z.of_int k) n.expo) (Z.neg (Z.of_string m))
    | None -> false
  in
  match c.goal with [ "area"; m ] -> reaches m c.area | [ "hausdorff"; m ] -> reaches m c.hausdorff | _ -> false

let bounds_hold c d e =
  Option.fold ~none:true ~some:(Checker.area_holds d e c.sites c.edges) c.area
  && Option.fold ~none:true ~some:(Checker.hausdorff_holds d e c.sites c.edges) c.hausdorff

let outcome_is_proved c left =
  match c.outcome with
  | "decided" -> left = 0
  | "certified" -> left = 0 && is_reached c
  | "fixpoint" -> c.exact
  | _ -> false

(* What a certificate says that cannot be. *)
let contradiction c d e left faces =
  let opened = c.ties + c.opened > 0 || c.capped in
  if c.outcome = "decided" && opened then Some "the outcome is not decided: pairs are open"
  else if c.outcome = "certified" && List.hd c.goal <> "voronoi" && not (is_reached c) then
    Some "the outcome is not certified: no bound reaches the goal"
  else if left = 0 && opened then Some "pairs are listed as open that are illegal"
  else if left = 0 && (c.faces <> faces || c.unproved > 0) then Some (Printf.sprintf "there are %d sure triangles" faces)
  else if left = 0 && not (bounds_hold c d e) then Some "a bound is too small"
  else None

let has_bounds c = c.area <> None || c.hausdorff <> None

let gaps c left =
  List.filter_map
    (fun (there, text) -> if there then Some ("not proved: " ^ text) else None)
    [ (left > 0 && not c.capped, Printf.sprintf "that pairs among %d sites which are not listed are illegal" left);
      (c.ties > 0 && not c.exact, Printf.sprintf "that no refinement decides %d ties" c.ties);
      (c.loose > 0, Printf.sprintf "that %d aliases of points that are not exact are the same points" c.loose);
      (has_bounds c && left > 0, "the bounds of area and Hausdorff distance, as more pairs may be possible");
      (c.blocks, "what points are described to be, which this checker does not know");
      (c.diagram, "the section on the Voronoi diagram, which this checker does not know");
      (not (outcome_is_proved c left), "the outcome " ^ c.outcome) ]

let report c left gaps =
  print_endline (if gaps = [] then "accepted, all of it proved" else "accepted, not all of it proved: see what is not proved below");
  Printf.printf "states: outcome %s, goal %s%s\n" c.outcome (String.concat " " c.goal) (if c.capped then ", capped" else "");
  Printf.printf "sites: %d, of which %d aliases\n" (List.length c.sites + c.aliases) c.aliases;
  Printf.printf "checked: %d legal pairs, each by its witness against all sites\n" (List.length c.edges);
  Printf.printf "checked: %d sites have no possible pairs but the legal ones\n" (List.length c.sites - left);
  if left = 0 then print_endline "checked: all pairs that are not listed are illegal";
  if left = 0 && has_bounds c then print_endline "checked: the bounds of area and Hausdorff distance";
  if outcome_is_proved c left then Printf.printf "checked: the outcome %s\n" c.outcome;
  if c.opened > 0 then Printf.printf "open: %d indeterminate pairs, of which nothing is stated\n" c.opened;
  if c.capped then print_endline "open: the cap was met, of other pairs nothing is stated";
  List.iter print_endline gaps

(* The exit status. *)
let verdict name =
  let c = certificate (whole_file name) in
  let d, e = Hints.unit_of c.sites c.edges in
  if not (Checker.check d e c.sites c.edges) then
    raise (Bad (line_at_fault c d e, "a point is no witness of its pair, or sites are not rectangles"));
  let left, faces = left_over c d e in
  Option.iter (fun wrong -> raise (Bad (2, wrong))) (contradiction c d e left faces);
  let found = gaps c left in
  report c left found;
  if found = [] then 0 else 3

let () =
  match Sys.argv with
  | [| _; name |] -> (
    match verdict name with
    | status -> exit status
    | exception Bad (line, message) -> Printf.eprintf "dyadel-proved: %s:%d: rejected: %s\n" name line message; exit 1
    | exception Sys_error message -> Printf.eprintf "dyadel-proved: %s\n" message; exit 1
    | exception (Stack_overflow | Out_of_memory) ->
      Printf.eprintf "dyadel-proved: %s: not known, as memory is exhausted\n" name;
      exit 1)
  | _ ->
    prerr_endline "usage: dyadel-proved FILE";
    exit 2
