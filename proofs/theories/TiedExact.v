(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The certain pairs in a face of exact points [TIE-2], by its rim alone: theorems of TiedFace.v, whose premise on all
   other points is what TiedRim.v shows. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Distance Cells Legal Orientation Disc Path Fan TiedFace TiedRim.
Open Scope R_scope.

Section Exact.
Variables (N : nat) (B : sites) (p : nat -> point) (T : list triangle) (H : list (nat * nat)).
Variable drawn : choice N B p.
Variable rim : rimmed N B p T H.
Variable distinct : forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w.
Variable points : forall v, face_vertex T H v -> exact (B v) (p v).

Lemma always_good m z : (m < N)%nat -> inside z (B m) -> good p T H z.
Proof.
  intros L I. destruct (classic (face_vertex T H m)) as [V | V].
  - rewrite (proj2 (points m V) z I). now apply (starts_good N B).
  - now apply (rim_keeps_out N B p T H drawn rim distinct m z L V I).
Qed.

Lemma never_at m v z : (m < N)%nat -> m <> v -> face_vertex T H v -> inside z (B m) -> z <> p v.
Proof.
  intros L D V I. destruct (classic (face_vertex T H m)) as [K | K].
  - rewrite (proj2 (points m K) z I). apply distinct; [exact L | now apply (vertex_below N B p T H rim) | exact D].
  - now apply (rim_keeps_out N B p T H drawn rim distinct m z L K I).
Qed.

Lemma circle_outside i j k o : In (Tri i j k o) T -> outside N B i j (p i) (p j) o (dist o (p i)).
Proof.
  intros F m M Di Dj z Z. destruct (corner_of N B p T H rim i j k o F) as [Vi [Vj _]]. split; [| split].
  - pose proof (proj1 (always_good m z M Z) _ F) as Q. simpl in Q. apply dist_le. unfold about in Q. lra.
  - now apply (never_at m i).
  - now apply (never_at m j).
Qed.

Lemma same_distance o a b : about o a b = 0 -> dist o b = dist o a.
Proof. intros E. apply dist_eq. unfold about in E. lra. Qed.

(* Between two triangles: legal if their circles are different, ... *)
Theorem face_edge_legal i j k l o w : In (Tri i j k o) T -> In (Tri j i l w) T -> dist o (p i) < dist o (p l) ->
  legal N B i j.
Proof.
  intros F G L. destruct (corner_of N B p T H rim _ _ _ _ F) as [Vi [Vj _]].
  destruct (proj1 rim _ _ _ _ F) as [_ [[Li [Lj _]] [[Ej [Ek O]] _]]].
  destruct (proj1 rim _ _ _ _ G) as [_ [_ [[Ei [El _]] _]]].
  assert (D : p i <> p j) by (intros X; unfold orient in O; rewrite X in O; lra).
  assert (W : outside N B i j (p i) (p j) w (dist w (p i))).
  { intros m M Di Dj z Z. destruct (circle_outside j i l w G m M Dj Di z Z) as [Q [Zj Zi]].
    rewrite (same_distance _ _ _ Ei). now split. }
  apply (tied_face_legal N B i j (p i) (p j) (p l) o (dist o (p i)) w (dist w (p i)) (points i Vi) (points j Vj) D);
    try assumption; try reflexivity.
  - now apply same_distance.
  - symmetry. now apply same_distance.
  - rewrite (same_distance _ _ _ El). symmetry. now apply same_distance.
  - now apply (circle_outside i j k).
Qed.

(* ... and not legal if they are the same. *)
Theorem face_edge_tie i j k l o w : In (Tri i j k o) T -> In (Tri j i l w) T -> dist o (p l) = dist o (p i) ->
  ~ legal N B i j.
Proof.
  intros F G E. destruct (corner_of N B p T H rim _ _ _ _ F) as [Vi [Vj [Vk _]]].
  destruct (corner_of N B p T H rim _ _ _ _ G) as [_ [_ [Vl _]]].
  destruct (proj1 rim _ _ _ _ F) as [_ [[Li [Lj Lk]] [[Ej [Ek O]] _]]].
  destruct (proj1 rim _ _ _ _ G) as [_ [[_ [_ Ll]] [[_ [_ O']] _]]].
  apply (tied_face_tie N B i j k l (p i) (p j) (p k) (p l) o (dist o (p i)) Lk Ll); auto.
  - intros ->. unfold orient in O. lra.
  - intros ->. unfold orient in O. lra.
  - intros ->. unfold orient in O'. lra.
  - intros ->. unfold orient in O'. lra.
  - unfold orient in *. lra.
  - repeat split; now apply same_distance.
Qed.

(* An edge with a ghost triangle is legal; *)
Theorem face_hull_edge i j k o : In (Tri i j k o) T -> In (i, j) H -> legal N B i j.
Proof.
  intros F G. destruct (corner_of N B p T H rim _ _ _ _ F) as [Vi [Vj _]].
  destruct (proj1 rim _ _ _ _ F) as [_ [_ [[Ej [_ O]] _]]].
  assert (D : p i <> p j) by (intros X; unfold orient in O; rewrite X in O; lra).
  apply (tied_face_hull_edge N B i j (p i) (p j) o (dist o (p i)) (points i Vi) (points j Vj) D); try reflexivity.
  - now apply same_distance.
  - now apply (circle_outside i j k).
  - intros m M Di Dj z Z. exact (proj2 (always_good m z M Z) _ G).
Qed.

(* the end of two of them is a sure vertex of the hull iff it is not on the line of its neighbours. *)
Theorem face_corner a v b : In (a, v) H -> In (v, b) H -> a <> b -> sure_hull N B v <-> orient (p a) (p v) (p b) <> 0.
Proof.
  intros F G D.
  assert (Va : face_vertex T H a) by (right; exists v; now left).
  assert (Vb : face_vertex T H b) by (right; exists v; now right).
  assert (Vv : face_vertex T H v) by (right; exists b; now left).
  destruct (proj2 rim _ _ F) as [[La [Lv Dav]] [Left [[k [Lk Ok]] _]]].
  destruct (proj2 rim _ _ G) as [[_ [Lb Dvb]] [Left' _]].
  split; intros Q.
  - intros O. apply (sure_hull_not_between N B p v a b Lv La Lb Dav (not_eq_sym Dvb) drawn Q).
    destruct (one_between _ _ _ O) as [X | [X | X]]; [| exact X |].
    + (* a between v and b: a site off the line is on the wrong side *)
      exfalso. destruct X as [t [S E]]. specialize (Left' k Lk).
      assert (t <> 0) by (intros ->; rewrite mix_0 in E; now apply (distinct a v La Lv Dav)).
      assert (t * orient (p v) (p b) (p k) = - orient (p a) (p v) (p k)).
      { rewrite E. unfold orient, mix. simpl. ring. }
      assert (0 <= t * orient (p v) (p b) (p k)) by (apply Rmult_le_pos; lra). lra.
    + exfalso. destruct X as [t [S E]]. specialize (Left' k Lk).
      assert (t <> 1) by (intros ->; rewrite mix_1 in E; now apply (distinct b v Lb Lv (not_eq_sym Dvb))).
      assert (orient (p v) (p b) (p k) = - (1 - t) * orient (p a) (p v) (p k)).
      { rewrite E. unfold orient, mix. simpl. ring. }
      assert (0 < (1 - t) * orient (p a) (p v) (p k)) by (apply Rmult_lt_0_compat; lra). lra.
  - assert (O : 0 < orient (p a) (p v) (p b)) by (specialize (Left b Lb); lra).
    destruct (tied_face_corner N B v (p a) (p v) (p b) O) as [u U].
    + intros m M Dm z Z. pose proof (always_good m z M Z) as K. split; [exact (proj2 K _ F) |].
      split; [exact (proj2 K _ G) | now apply (never_at m v)].
    + exists u. intros m x y M Dm X Y. rewrite (proj2 (points v Vv) x X). now apply (U m).
Qed.
End Exact.
