(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* When all faces are triangles and all edges are legal, all other pairs are illegal.
   The premise is about one choice only, the skeleton, and is what a triangulation of its points gives at each site. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc Crossing Path Fan.
Open Scope R_scope.

(* The faces round the site a: triangles a, i, j of the skeleton p, counterclockwise, with legal edges and no further
   site in them. Each side ai either belongs to another face too, or is a hull edge: all sites are on one side of it, and
   i is a sure hull vertex. *)
Definition complete_fan (N : nat) (B : sites) (p : nat -> point) (a : nat) (faces : list (nat * nat)) : Prop :=
  faces <> nil /\ forall i j, In (i, j) faces ->
    ((i < N)%nat /\ (j < N)%nat /\ i <> a /\ j <> a /\ i <> j) /\
    (legal N B a i /\ legal N B a j /\ legal N B i j) /\
    0 < orient (p a) (p i) (p j) /\
    (forall m, (m < N)%nat -> m <> a -> m <> i -> m <> j ->
      ~ (0 <= orient (p a) (p i) (p m) /\ 0 <= orient (p a) (p m) (p j) /\ 0 <= orient (p i) (p j) (p m))) /\
    ((exists l, In (l, i) faces) \/
     (sure_hull N B i /\ forall m, (m < N)%nat -> 0 <= orient (p a) (p i) (p m))) /\
    ((exists l, In (j, l) faces) \/
     (sure_hull N B j /\ forall m, (m < N)%nat -> 0 <= orient (p a) (p m) (p j))).

(* What of it is about places alone. *)
Definition fan_round (N : nat) (p : nat -> point) (a : nat) (faces : list (nat * nat)) : Prop :=
  faces <> nil /\ forall i j, In (i, j) faces ->
    ((i < N)%nat /\ (j < N)%nat) /\ 0 < orient (p a) (p i) (p j) /\
    ((exists l, In (l, i) faces) \/ forall m, (m < N)%nat -> 0 <= orient (p a) (p i) (p m)) /\
    ((exists l, In (j, l) faces) \/ forall m, (m < N)%nat -> 0 <= orient (p a) (p m) (p j)).

Lemma complete_fan_round N B p a faces : complete_fan N B p a faces -> fan_round N p a faces.
Proof.
  intros [Ne H]. split; [exact Ne |]. intros i j F. destruct (H i j F) as [[I [J _]] [_ [D [_ [X Y]]]]].
  split; [now split |]. split; [exact D |]. split; [destruct X as [X | [_ X]] | destruct Y as [Y | [_ Y]]]; auto.
Qed.

(* Directions from a: the cone of the face a, i, j. *)
Definition in_cone (x y z w : point) : Prop := 0 <= orient x y w /\ 0 <= orient x w z.

Section Cones.
Variables (N : nat) (p : nat -> point) (a : nat) (faces : list (nat * nat)).
Variable fan : fan_round N p a faces.

Definition covered (x : point) : Prop := exists i j, In (i, j) faces /\ in_cone (p a) (p i) (p j) x.

Section Segment.
(* From one point to another, on the inner side of the hull edges, not through a. *)
Variables (y z : point).
Variable inner_left : forall i j, In (i, j) faces -> (exists l, In (l, i) faces) \/
  (0 <= orient (p a) (p i) y /\ 0 <= orient (p a) (p i) z).
Variable inner_right : forall i j, In (i, j) faces -> (exists l, In (j, l) faces) \/
  (0 <= orient (p a) y (p j) /\ 0 <= orient (p a) z (p j)).
Variable avoids : forall t, 0 <= t <= 1 -> mix t y z <> p a.
Let x t := mix t y z.

Lemma side_continuous u v : continuity (fun t => orient u v (x t)).
Proof. unfold x, orient, mix. simpl. reg. Qed.

Lemma side_continuous' u v : continuity (fun t => orient u (x t) v).
Proof. unfold x, orient, mix. simpl. reg. Qed.

Lemma not_both_zero t i j : 0 <= t <= 1 -> In (i, j) faces ->
  orient (p a) (p i) (x t) = 0 -> orient (p a) (x t) (p j) = 0 -> False.
Proof.
  intros T F O1 O2. destruct fan as [_ H]. destruct (H i j F) as [_ [D _]].
  apply (avoids t T). fold (x t). set (w := x t) in *.
  pose proof (bary_sum (p a) (p i) (p j) w) as S. pose proof (bary_x (p a) (p i) (p j) w) as X.
  pose proof (bary_y (p a) (p i) (p j) w) as Y. rewrite O1, O2 in *.
  apply (scaled_point_eq (orient (p a) (p i) (p j))); [lra | |]; [rewrite X | rewrite Y];
    replace (orient (p i) (p j) w) with (orient (p a) (p i) (p j)) by lra; ring.
Qed.

Lemma cone_left_near t i j : 0 <= t <= 1 -> In (i, j) faces -> in_cone (p a) (p i) (p j) (x t) ->
  near t (fun s => 0 <= s <= 1 -> 0 <= orient (p a) (p i) (x s) \/ covered (x s)).
Proof.
  intros T F [O1 O2]. destruct (Req_dec (orient (p a) (p i) (x t)) 0) as [Z | Z].
  - destruct (inner_left i j F) as [[l G] | [Hy Hz]].
    + destruct fan as [_ H]. destruct (H i j F) as [_ [D _]]. destruct (H l i G) as [_ [D' _]].
      assert (P2 : 0 < orient (p a) (x t) (p j)).
      { destruct (Req_dec (orient (p a) (x t) (p j)) 0) as [Z' | Z']; [exfalso; now apply (not_both_zero t i j) | lra]. }
      assert (E : orient (p a) (p i) (p j) * orient (p a) (p l) (x t) =
        orient (p a) (x t) (p j) * orient (p a) (p l) (p i) + orient (p a) (p i) (x t) * orient (p a) (p l) (p j))
        by (unfold orient; ring).
      assert (W : 0 < orient (p a) (p l) (x t)).
      { apply (Rmult_lt_reg_l (orient (p a) (p i) (p j))); [exact D |]. rewrite E, Z.
        assert (0 < orient (p a) (x t) (p j) * orient (p a) (p l) (p i)) by (now apply Rmult_lt_0_compat). lra. }
      pose proof (near_positive _ t (side_continuous (p a) (p l)) W) as K. revert K. apply near_weaken. intros s W' _.
      destruct (Rle_dec 0 (orient (p a) (p i) (x s))) as [Y | Y]; [now left | right].
      exists l, i. split; [exact G |]. split; [lra |]. rewrite orient_swap. lra.
    + exists 1. split; [lra |]. intros s _ S. left.
      replace (orient (p a) (p i) (x s)) with ((1 - s) * orient (p a) (p i) y + s * orient (p a) (p i) z)
        by (unfold x, orient, mix; simpl; ring).
      assert (0 <= (1 - s) * orient (p a) (p i) y) by (apply Rmult_le_pos; lra).
      assert (0 <= s * orient (p a) (p i) z) by (apply Rmult_le_pos; lra). lra.
  - assert (W : 0 < orient (p a) (p i) (x t)) by lra.
    pose proof (near_positive _ t (side_continuous (p a) (p i)) W) as K. revert K. apply near_weaken. intros s Y _. left. lra.
Qed.

Lemma cone_right_near t i j : 0 <= t <= 1 -> In (i, j) faces -> in_cone (p a) (p i) (p j) (x t) ->
  near t (fun s => 0 <= s <= 1 -> 0 <= orient (p a) (x s) (p j) \/ covered (x s)).
Proof.
  intros T F [O1 O2]. destruct (Req_dec (orient (p a) (x t) (p j)) 0) as [Z | Z].
  - destruct (inner_right i j F) as [[l G] | [Hy Hz]].
    + destruct fan as [_ H]. destruct (H i j F) as [_ [D _]]. destruct (H j l G) as [_ [D' _]].
      assert (P1 : 0 < orient (p a) (p i) (x t)).
      { destruct (Req_dec (orient (p a) (p i) (x t)) 0) as [Z' | Z']; [exfalso; now apply (not_both_zero t i j) | lra]. }
      assert (E : orient (p a) (p i) (p j) * orient (p a) (x t) (p l) =
        orient (p a) (x t) (p j) * orient (p a) (p i) (p l) + orient (p a) (p i) (x t) * orient (p a) (p j) (p l))
        by (unfold orient; ring).
      assert (W : 0 < orient (p a) (x t) (p l)).
      { apply (Rmult_lt_reg_l (orient (p a) (p i) (p j))); [exact D |]. rewrite E, Z.
        assert (0 < orient (p a) (p i) (x t) * orient (p a) (p j) (p l)) by (now apply Rmult_lt_0_compat). lra. }
      pose proof (near_positive _ t (side_continuous' (p a) (p l)) W) as K. revert K. apply near_weaken. intros s W' _.
      destruct (Rle_dec 0 (orient (p a) (x s) (p j))) as [Y | Y]; [now left | right].
      exists j, l. split; [exact G |]. split; [rewrite orient_swap; lra | lra].
    + exists 1. split; [lra |]. intros s _ S. left.
      replace (orient (p a) (x s) (p j)) with ((1 - s) * orient (p a) y (p j) + s * orient (p a) z (p j))
        by (unfold x, orient, mix; simpl; ring).
      assert (0 <= (1 - s) * orient (p a) y (p j)) by (apply Rmult_le_pos; lra).
      assert (0 <= s * orient (p a) z (p j)) by (apply Rmult_le_pos; lra). lra.
  - assert (W : 0 < orient (p a) (x t) (p j)) by lra.
    pose proof (near_positive _ t (side_continuous' (p a) (p j)) W) as K. revert K. apply near_weaken. intros s Y _. left. lra.
Qed.

Lemma covered_along : covered y -> covered z.
Proof.
  intros Y0. assert (E1 : x 1 = z) by apply mix_1. rewrite <- E1.
  apply (open_closed (fun t => covered (x t))).
  - assert (E0 : x 0 = y) by apply mix_0. now rewrite E0.
  - intros t T [i [j [F Cn]]].
    destruct (near_and _ _ _ (cone_left_near t i j T F Cn) (cone_right_near t i j T F Cn)) as [e [E G]].
    exists e. split; [exact E |]. intros s S S01. destruct (G s S) as [G1 G2].
    destruct (G1 S01) as [O1 | K]; [| exact K]. destruct (G2 S01) as [O2 | K]; [| exact K]. now exists i, j.
  - intros t T Nc.
    assert (K : near t (fun s => forall f, In f faces -> ~ in_cone (p a) (p (fst f)) (p (snd f)) (x s))).
    { apply near_list. intros [i j] F. simpl.
      destruct (Rle_dec 0 (orient (p a) (p i) (x t))) as [O1 | O1].
      - destruct (Rle_dec 0 (orient (p a) (x t) (p j))) as [O2 | O2].
        + exfalso. apply Nc. now exists i, j.
        + apply Rnot_le_lt in O2. pose proof (near_negative _ t (side_continuous' (p a) (p j)) O2) as K.
          revert K. apply near_weaken. intros s W [_ Y]. lra.
      - apply Rnot_le_lt in O1. pose proof (near_negative _ t (side_continuous (p a) (p i)) O1) as K.
        revert K. apply near_weaken. intros s W [Y _]. lra. }
    destruct K as [e [E G]]. exists e. split; [exact E |]. intros s S _ [i [j [F Cn]]]. now apply (G s S (i, j)).
Qed.
End Segment.

(* The cones of the faces cover all sites. *)
Lemma sites_covered b : (a < N)%nat -> (b < N)%nat -> p b <> p a -> covered (p b).
Proof.
  intros Ha Hb Nb. destruct fan as [Ne H]. destruct faces as [| [i j] rest] eqn:Ef; [now elim Ne |].
  assert (F : In (i, j) faces) by (rewrite Ef; now left). rewrite <- Ef in *.
  destruct (H i j F) as [[I J] [D _]].
  assert (Start : forall m, (m < N)%nat -> covered (p m) -> (forall t, 0 <= t <= 1 -> mix t (p m) (p b) <> p a) -> covered (p b)).
  { intros m M Cm Av. apply covered_along with (p m); [| | exact Av | exact Cm].
    - intros k l K. destruct (H k l K) as [_ [_ [[X | X] _]]]; [now left | right; split; now apply X].
    - intros k l K. destruct (H k l K) as [_ [_ [_ [X | X]]]]; [now left | right; split; now apply X]. }
  assert (Ci : covered (p i)).
  { exists i, j. split; [exact F |]. split; [unfold orient; lra | lra]. }
  assert (Cj : covered (p j)).
  { exists i, j. split; [exact F |]. split; [lra | unfold orient; lra]. }
  destruct (classic (exists t, 0 <= t <= 1 /\ mix t (p i) (p b) = p a)) as [[t [T E]] | Nt].
  - destruct (classic (exists s, 0 <= s <= 1 /\ mix s (p j) (p b) = p a)) as [[s [S E']] | Ns].
    + (* a would be on the segments from b to i and to j *)
      exfalso.
      assert (O1 : orient (p a) (p i) (p b) = 0) by (rewrite <- E; unfold orient, mix; simpl; ring).
      assert (O2 : orient (p a) (p b) (p j) = 0) by (rewrite <- E'; unfold orient, mix; simpl; ring).
      pose proof (bary_sum (p a) (p i) (p j) (p b)) as Sm. pose proof (bary_x (p a) (p i) (p j) (p b)) as X.
      pose proof (bary_y (p a) (p i) (p j) (p b)) as Y. rewrite O1, O2 in *. apply Nb.
      apply (scaled_point_eq (orient (p a) (p i) (p j))); [lra | |]; [rewrite X | rewrite Y];
        replace (orient (p i) (p j) (p b)) with (orient (p a) (p i) (p j)) by lra; ring.
    + apply (Start j J Cj). intros s S E'. apply Ns. now exists s.
  - apply (Start i I Ci). intros t T E. apply Nt. now exists t.
Qed.
End Cones.

(* All faces round a are triangles with legal edges: no other pair of a is possible, for any choice. *)
Theorem other_pairs_are_illegal N B p a b faces : (a < N)%nat -> (b < N)%nat -> a <> b -> choice N B p ->
  complete_fan N B p a faces -> (forall i j, In (i, j) faces -> b <> i /\ b <> j) -> ~ possible N B a b.
Proof.
  intros Ha Hb Dab P Fan Nb. pose proof Fan as [Ne H].
  assert (Edges : legal_faces N B a b faces).
  { intros i j F. destruct (H i j F) as [[I [J [Dia [Dja Dij]]]] [[La [Lj Lij]] _]]. destruct (Nb i j F).
    repeat split; try assumption. now apply not_eq_sym. }
  assert (Gap : no_gap N B faces).
  { intros i j F. destruct (H i j F) as [_ [_ [_ [_ [X Y]]]]]. split.
    - destruct X as [X | [X _]]; [now right | now left].
    - destruct Y as [Y | [Y _]]; [now right | now left]. }
  assert (Left : all_left a faces p) by (intros i j F; now destruct (H i j F) as [_ [_ [D _]]]).
  assert (Npq : p b <> p a).
  { destruct faces as [| [i j] rest]; [now elim Ne |].
    destruct (H i j (or_introl eq_refl)) as [[I _] [[La _] _]]. destruct (Nb i j (or_introl eq_refl)).
    destruct (legal_sound N B a i p Ha I La P) as [o [_ Out]]. intros E.
    pose proof (Out b Hb (not_eq_sym Dab) H0) as X. rewrite E in X. lra. }
  destruct (sites_covered N p a faces (complete_fan_round _ _ _ _ _ Fan) b Ha Hb Npq) as [i [j [F [O1 O2]]]].
  apply (rest_is_illegal N B a b faces Ha Hb Edges Gap p P Left). exists i, j. split; [exact F |].
  split; [exact O1 |]. split; [exact O2 |]. destruct (Nb i j F) as [Di Dj].
  destruct (H i j F) as [_ [_ [_ [Empty _]]]].
  apply Rnot_lt_le. intros C. apply (Empty b Hb (not_eq_sym Dab) Di Dj). repeat split; lra.
Qed.

(* All faces of the skeleton are triangles and all its edges are legal: every pair that is no edge is illegal. *)
Corollary triangulation_is_decided N B p (fan : nat -> list (nat * nat)) : choice N B p ->
  (forall a, (a < N)%nat -> complete_fan N B p a (fan a)) ->
  forall a b, (a < N)%nat -> (b < N)%nat -> a <> b ->
    (exists i j, In (i, j) (fan a) /\ (b = i \/ b = j) /\ legal N B a b) \/ ~ possible N B a b.
Proof.
  intros P Fan a b Ha Hb D. destruct (classic (exists i j, In (i, j) (fan a) /\ (b = i \/ b = j))) as [[i [j [F E]]] | E].
  - left. exists i, j. split; [exact F |]. split; [exact E |]. destruct (Fan a Ha) as [_ H].
    destruct (H i j F) as [_ [[La [Lj _]] _]]. destruct E as [-> | ->]; assumption.
  - right. apply (other_pairs_are_illegal N B p a b (fan a)); auto. intros i j F.
    split; intros ->; apply E; [exists i, j | exists i, j]; tauto.
Qed.
