(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A checker for the legal pairs of a certificate (include/dyadel/certificate.h), over Z, written to be extracted.
   CheckerSound.v says what its answer means. *)
From Coq Require Import ZArith List Bool.
From Dyadel Require Export CheckerTree.
Import ListNotations.
Open Scope Z_scope.

(* man * 2^expo / den, as the certificate writes it. *)
Record number : Type := Number { man : Z; expo : Z; den : Z }.

(* A site: its number and the ends of its rectangle. Aliases are omitted. *)
Record site : Type := Site { name : Z; left : number; right : number; low : number; high : number }.

(* A legal pair and its witness. *)
Record edge : Type := Edge { from : Z; to : Z; at_x : number; at_y : number }.

(* The same in units of 1 / (D 2^E): integers. *)
Definition scaled (D E : Z) (n : number) : option Z :=
  if (0 <? den n) && (0 <=? expo n + E) && (D mod den n =? 0)
  then Some (Z.shiftl (man n * (D / den n)) (expo n + E)) else None.

Definition scaled_site (D E : Z) (s : site) : option box :=
  match scaled D E (left s), scaled D E (right s), scaled D E (low s), scaled D E (high s) with
  | Some a, Some b, Some c, Some d => if (a <=? b) && (c <=? d) then Some (Box (name s) a b c d) else None
  | _, _, _, _ => None
  end.

Fixpoint scaled_onto (D E : Z) (l : list site) (before : list box) : option (list box) :=
  match l with
  | [] => Some (rev_append before [])
  | s :: rest => match scaled_site D E s with Some b => scaled_onto D E rest (b :: before) | None => None end
  end.

Definition scaled_sites (D E : Z) (l : list site) : option (list box) := scaled_onto D E l [].

(* Distances along one axis: to the nearest point of [lo,hi], and to the farthest one. *)
Definition gap (lo hi t : Z) : Z := if t <? lo then lo - t else if hi <? t then t - hi else 0.
Definition reach (lo hi t : Z) : Z := Z.max (t - lo) (hi - t).

Definition ds2 (x y : Z) (b : box) : Z :=
  let u := gap (x0 b) (x1 b) x in let v := gap (y0 b) (y1 b) y in u * u + v * v.
Definition dl2 (x y : Z) (b : box) : Z :=
  let u := reach (x0 b) (x1 b) x in let v := reach (y0 b) (y1 b) y in u * u + v * v.

(* Is the box off the disc about (x,y) with squared radius r2, r2 <= s^2? Most boxes are off the square around it, which
   costs no product: with many denominators numbers are long. *)
Definition off_disc (x y r2 s : Z) (b : box) : bool :=
  let u := gap (x0 b) (x1 b) x in let v := gap (y0 b) (y1 b) y in (s <? u) || (s <? v) || (r2 <? u * u + v * v).

Definition reaches (x y : Z) (b : box) : Z := reach (x0 b) (x1 b) x + reach (y0 b) (y1 b) y.

(* Boxes by name, and the tree of all of them. *)
Definition check_witness (m : Map.t box) (t : tree) (i j x y : Z) : bool :=
  match Map.find i m, Map.find j m with
  | Some a, Some b =>
    let r2 := Z.max (dl2 x y a) (dl2 x y b) in let s := Z.max (reaches x y a) (reaches x y b) in
    let off := off_disc x y r2 s in
    (0 <=? s) && (r2 <=? s * s) &&
    all_in off (fun k => off k || (box_name k =? i) || (box_name k =? j)) t
  | _, _ => false
  end.

Definition check_edge (D E : Z) (m : Map.t box) (t : tree) (e : edge) : bool :=
  match scaled D E (at_x e), scaled D E (at_y e) with
  | Some x, Some y => check_witness m t (from e) (to e) x y
  | _, _ => false
  end.

(* Names must rise: no two sites have one name. *)
Fixpoint rising (last : Z) (boxes : list box) : bool :=
  match boxes with
  | [] => true
  | b :: rest => (last <? box_name b) && rising (box_name b) rest
  end.

(* D and E only choose the unit; a wrong choice makes the answer false, never wrong. *)
Definition check (D E : Z) (sites : list site) (edges : list edge) : bool :=
  match scaled_sites D E sites with
  | Some boxes =>
    (0 <? D) && rising (-1) boxes && forallb (check_edge D E (index box_name boxes) (build deepest boxes)) edges
  | None => false
  end.
