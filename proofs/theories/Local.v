(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Only the faces at i and j can spoil a witness of ij [LOC-3]. Round i the rim of its faces is a closed polygon of
   legal edges, which winds around i and not around sites that are not a corner of these faces, for every choice; so the
   way from i to such a site crosses a legal edge, and so does that from j. A disc that holds the three and no other
   corner would then have two legal edges cross. *)
From Coq Require Import Reals Lra Lia Psatz Classical List ZArith Permutation.
From Dyadel Require Import Plane Distance Cells Legal Orientation Nerve Disc Crossing Path Fan TiedRim Winding.
Open Scope R_scope.

(* ---- legal edges and a disc ---- *)

(* A disc holds x and y and neither end of a legal edge, they are not its ends: the edge does not pass between. *)
Lemma edge_aside N p a b x y c r t : (a < N)%nat -> (b < N)%nat -> (x < N)%nat -> (y < N)%nat ->
  strict_edge N p a b -> x <> a -> x <> b -> y <> a -> y <> b ->
  dist c (p x) <= r -> dist c (p y) <= r -> r < dist c (p a) -> r < dist c (p b) -> 0 <= t <= 1 ->
  ~ between (mix t (p x) (p y)) (p a) (p b).
Proof.
  intros A B X Y [o [Eq Out]] Xa Xb Ya Yb Dx Dy Da Db T [s [S E]].
  assert (R0 : 0 <= r) by (pose proof (dist_nonneg c (p x)); lra).
  set (f z := power c r z - power o (dist o (p a)) z).
  assert (Aff : forall q u v, f (mix q u v) = (1 - q) * f u + q * f v) by (intros; unfold f, power, dist2, mix;
    simpl; ring).
  assert (Fa : 0 < f (p a)) by (unfold f; rewrite (power_zero o) by reflexivity;
    pose proof (power_gt c r (p a) R0 Da); lra).
  assert (Fb : 0 < f (p b)).
  { unfold f. rewrite (power_zero o) by now symmetry. pose proof (power_gt c r (p b) R0 Db). lra. }
  assert (In : forall z, (z < N)%nat -> z <> a -> z <> b -> dist c (p z) <= r -> f (p z) < 0).
  { intros z Z Za Zb D. unfold f. pose proof (power_le c r (p z) D).
    pose proof (power_gt o (dist o (p a)) (p z) (dist_nonneg _ _) (Out z Z Za Zb)). lra. }
  pose proof (In x X Xa Xb Dx) as Fx. pose proof (In y Y Ya Yb Dy) as Fy.
  pose proof (Aff t (p x) (p y)) as U. rewrite E, Aff in U.
  assert (0 <= (1 - s) * f (p a)) by (apply Rmult_le_pos; lra). assert (0 <= s * f (p b)) by (apply Rmult_le_pos; lra).
  assert (0 <= (1 - t) * - f (p x)) by (apply Rmult_le_pos; lra).
    assert (0 <= t * - f (p y)) by (apply Rmult_le_pos; lra).
  destruct (Req_dec s 0) as [-> | S0]; [| assert (0 < s * f (p b)) by (apply Rmult_lt_0_compat; lra); nra].
  destruct (Req_dec t 0) as [-> | T0]; [| assert (0 < t * - f (p y)) by (apply Rmult_lt_0_compat; lra); nra]. nra.
Qed.

(* Lines from two corners of a triangle to the sides opposite meet. *)
Lemma cevians i j k s t : 0 <= s <= 1 -> 0 <= t <= 1 -> 0 < s + t ->
  exists u v, 0 <= u <= 1 /\ 0 <= v <= 1 /\ mix u j (mix s i k) = mix v i (mix t j k).
Proof.
  intros S T P. set (d := s + t - s * t). assert (D : 0 < d) by (unfold d; nra).
  assert (Part : forall a, 0 <= a <= d -> 0 <= a / d <= 1).
  { intros a A. split; [apply Rdiv_le_0_compat || (apply Rmult_le_pos; [lra | left; now apply Rinv_0_lt_compat]);
    lra |].
    apply (Rmult_le_reg_r d); [exact D |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  exists (t / d), (s / d). split; [apply Part; unfold d; nra |]. split; [apply Part; unfold d; nra |].
  unfold mix. simpl. f_equal; unfold d; field; fold d; lra.
Qed.

Lemma legal_apart N p a b : strict_edge N p a b -> strict_edge N p b a.
Proof. intros [o [E O]]. exists o. split; [now symmetry |]. intros k K Kb Ka. rewrite <- E. now apply O. Qed.

(* j b meets the way from i to k, and i b' that from j to k; neither b nor b' is in the disc: impossible. *)
Lemma two_crossings N p i j k b b' c r s t : (i < N)%nat -> (j < N)%nat -> (k < N)%nat -> (b < N)%nat -> (b' < N)%nat ->
  i <> j -> k <> i -> k <> j -> strict_edge N p j b -> strict_edge N p i b' ->
  dist c (p i) <= r -> dist c (p j) <= r -> dist c (p k) <= r -> r < dist c (p b) -> r < dist c (p b') ->
  0 <= s <= 1 -> 0 <= t <= 1 -> between (mix s (p i) (p k)) (p j) (p b) ->
    between (mix t (p j) (p k)) (p i) (p b') -> False.
Proof.
  intros I J K Bn B'n Dij Ki Kj L L' Ci Cj Ck Cb Cb' S T [x [X Ex]] [y [Y Ey]].
  assert (Bi : b <> i) by (intros ->; lra). assert (Bj : b <> j) by (intros ->; lra).
  assert (B'i : b' <> i) by (intros ->; lra). assert (B'j : b' <> j) by (intros ->; lra).
  assert (S0 : s <> 0).
  { intros ->. rewrite mix_0 in Ex. apply (edge_is_free N p j b i I Dij (not_eq_sym Bi) L). now exists x. }
  destruct (cevians (p i) (p j) (p k) s t S T) as [u [v [U [V E]]]]; [lra |].
  rewrite Ex, Ey in E. set (z := mix u (p j) (mix x (p j) (p b))) in E.
  assert (Z1 : z = mix (u * x) (p j) (p b)) by (unfold z, mix; simpl; f_equal; ring).
  assert (Z2 : z = mix (v * y) (p i) (p b')) by (rewrite E; unfold mix; simpl; f_equal; ring).
  assert (Q1 : 0 <= u * x <= 1) by nra. assert (Q2 : 0 <= v * y <= 1) by nra.
  assert (Zr : dist c z <= r).
  { unfold z. apply disc_convex; [exact U | exact Cj |]. rewrite <- Ex. now apply disc_convex. }
  destruct (Nat.eq_dec b b') as [<- | D].
  - (* both end at b, z is not b: one of i, j is on the other edge *)
    set (m := u * x) in *. set (n := v * y) in *.
      assert (M1 : m <> 1) by (intros M; rewrite M, mix_1 in Z1; rewrite Z1 in Zr; lra).
    assert (N1 : n <> 1) by (intros M; rewrite M, mix_1 in Z2; rewrite Z2 in Zr; lra). rewrite Z1 in Z2.
    destruct (Rle_dec m n) as [Le | Le].
    + (* (1-m) (j - b) = (1-n) (i - b): j is between i and b *)
      apply (edge_is_free N p i b j J (not_eq_sym Dij) (not_eq_sym Bj) L'). exists ((n - m) / (1 - m)). split.
      * split; [apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat; lra] |].
        apply (Rmult_le_reg_r (1 - m)); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
      * pose proof (f_equal fst Z2) as F1. pose proof (f_equal snd Z2) as F2. unfold mix in F1, F2 |- *.
        simpl in F1, F2.
        rewrite (surjective_pairing (p j)). f_equal; apply (Rmult_eq_reg_l (1 - m)); try lra.
        -- transitivity ((1 - n) * fst (p i) + (n - m) * fst (p b)); [lra | field; lra].
        -- transitivity ((1 - n) * snd (p i) + (n - m) * snd (p b)); [lra | field; lra].
    + apply (edge_is_free N p j b i I Dij (not_eq_sym Bi) L). exists ((m - n) / (1 - n)). split.
      * split; [apply Rmult_le_pos; [lra | left; apply Rinv_0_lt_compat; lra] |].
        apply (Rmult_le_reg_r (1 - n)); [lra |]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
      * pose proof (f_equal fst Z2) as F1. pose proof (f_equal snd Z2) as F2. unfold mix in F1, F2 |- *.
        simpl in F1, F2.
        rewrite (surjective_pairing (p i)). f_equal; apply (Rmult_eq_reg_l (1 - n)); try lra.
        -- transitivity ((1 - m) * fst (p j) + (m - n) * fst (p b)); [lra | field; lra].
        -- transitivity ((1 - m) * snd (p j) + (m - n) * snd (p b)); [lra | field; lra].
  - assert (Disc : disc_edge N p i b').
    { destruct L' as [o [Eo Oo]]. exists o, (dist o (p i)). split; [| split].
      - pose proof (dist_nonneg o (p i)). destruct (Req_dec (dist o (p i)) 0) as [W | W]; [exfalso | lra].
        rewrite W in Eo. symmetry in Eo.
        assert (P : p i = p b') by (rewrite <- (dist_zero _ _ W); now apply dist_zero).
        rewrite P in Ci. lra.
      - intros w _ [-> | ->]; [reflexivity | now symmetry].
      - intros w W. destruct (Nat.eq_dec w i) as [-> | Wi]; [lra |]. destruct (Nat.eq_dec w b') as [-> | Wb]; [lra |].
        left. now apply Oo. }
    apply (edges_do_not_cross N p j b i b' z J Bn I B'n Dij (not_eq_sym Bi) B'j (not_eq_sym D) L Disc);
      [now exists (u * x) | now exists (v * y)].
Qed.

(* ---- the rim ---- *)

(* The ghost represents places far out: corners from N on, of which some go along with a site. *)
Record far_out : Type := Far { anchor : nat -> nat; scale : nat -> R; offset : nat -> point }.

Definition place (N : nat) (f : far_out) (p : nat -> point) (v : nat) : point :=
  if Nat.ltb v N then p v else
  (scale f v * fst (p (anchor f v)) + fst (offset f v), scale f v * snd (p (anchor f v)) + snd (offset f v)).

(* A side of a rim: a legal edge; or a way from a sure vertex of the hull outward, or one far out: it is beyond all
   others in some direction, for every choice. *)
Definition rim_side (N : nat) (B : sites) (f : far_out) (a b : nat) : Prop :=
  ((a < N)%nat /\ (b < N)%nat /\ a <> b /\ legal N B a b) \/
  exists u, forall p x, choice N B p -> (x < N)%nat -> x <> a -> x <> b ->
    dot u (p x) < dot u (place N f p a) /\ dot u (p x) < dot u (place N f p b).

(* The faces at i, in the skeleton q. L: the triangles i, a, b round i, once round; Rest: the other triangles; E: their
   rim, no side of it at i. No other site is in these triangles. *)
Definition faces_round (N : nat) (B : sites) (f : far_out) (q : nat -> point) (i : nat) (L : list (nat * nat))
  (Rest : list (nat * nat * nat)) (E : list (nat * nat)) : Prop :=
  rim_of (map (fun e => (i, fst e, snd e)) L ++ Rest) E /\ closed L /\ L <> nil /\
  (forall a b, In (a, b) E -> a <> i /\ b <> i /\ rim_side N B f a b) /\
  (forall a b c, In (a, b, c) (map (fun e => (i, fst e, snd e)) L ++ Rest) ->
    0 < orient (place N f q a) (place N f q b) (place N f q c) /\
    forall m, (m < N)%nat -> m <> a -> m <> b -> m <> c -> ~ (0 <= orient (place N f q a) (place N f q b) (q m) /\
      0 <= orient (place N f q b) (place N f q c) (q m) /\ 0 <= orient (place N f q c) (place N f q a) (q m))) /\
  (forall a b c, In (a, b, c) Rest -> a <> i /\ b <> i /\ c <> i).

Definition face_corner (i : nat) (L : list (nat * nat)) (Rest : list (nat * nat * nat)) (k : nat) : Prop :=
  exists a b c, In (a, b, c) (map (fun e => (i, fst e, snd e)) L ++ Rest) /\ (k = a \/ k = b \/ k = c).

Lemma place_site N f p v : (v < N)%nat -> place N f p v = p v.
Proof. intros L. unfold place. apply Nat.ltb_lt in L. now rewrite L. Qed.

Lemma place_same N f p p' v : (forall k, p k = p' k) -> place N f p v = place N f p' v.
Proof. intros Same. unfold place. now rewrite !Same. Qed.

Section Round.
Variables (N : nat) (B : sites) (f : far_out) (q : nat -> point) (i : nat).
Variables (L : list (nat * nat)) (Rest : list (nat * nat * nat)) (E : list (nat * nat)).
Variable drawn : choice N B q.
Variable below : (i < N)%nat.
Variable round : faces_round N B f q i L Rest E.

Lemma rim_corner a b : In (a, b) E -> face_corner i L Rest a /\ face_corner i L Rest b.
Proof.
  intros F. destruct round as [[I P] _].
  assert (G : In (a, b) (flat_map sides (map (fun e => (i, fst e, snd e)) L ++ Rest))).
  { apply (Permutation_in _ (Permutation_sym P)), in_or_app. now left. }
  apply in_flat_map in G as [[[x y] z] [G S]]. simpl in S.
  split; exists x, y, z; (split; [exact G |]);
    destruct S as [S | [S | [S | []]]]; injection S; intros; subst; auto.
Qed.

(* Far out no site passes. *)
Lemma not_far p x y t a b u : (x < N)%nat -> (y < N)%nat -> choice N B p -> x <> a -> x <> b -> y <> a -> y <> b ->
  0 <= t <= 1 -> (forall p x, choice N B p -> (x < N)%nat -> x <> a -> x <> b ->
    dot u (p x) < dot u (place N f p a) /\ dot u (p x) < dot u (place N f p b)) ->
  ~ between (mix t (p x) (p y)) (place N f p a) (place N f p b).
Proof.
  intros X Y P Xa Xb Ya Yb T U [s [S Eq]]. destruct (U p x P X Xa Xb) as [U1 U2]. destruct (U p y P Y Ya Yb) as [U3 U4].
  assert (D : dot u (mix t (p x) (p y)) = dot u (mix s (place N f p a) (place N f p b))) by now rewrite Eq.
  rewrite !dot_mix in D. set (m := Rmin (dot u (place N f p a)) (dot u (place N f p b))).
  pose proof (Rmin_l (dot u (place N f p a)) (dot u (place N f p b))) as M1. fold m in M1.
  pose proof (Rmin_r (dot u (place N f p a)) (dot u (place N f p b))) as M2. fold m in M2.
  assert (X1 : dot u (p x) < m) by (now apply Rmin_glb_lt). assert (Y1 : dot u (p y) < m) by (now apply Rmin_glb_lt).
  assert (0 <= (1 - s) * (dot u (place N f p a) - m)) by (apply Rmult_le_pos; lra).
  assert (0 <= s * (dot u (place N f p b) - m)) by (apply Rmult_le_pos; lra).
  assert (0 <= (1 - t) * (m - dot u (p x))) by (apply Rmult_le_pos; lra).
  destruct (Req_dec t 0) as [-> | T0]; [lra |].
  assert (0 < t * (m - dot u (p y))) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Definition wind (p : nat -> point) (z : point) : Z := total (fun a b => passes z (place N f p a) (place N f p b)) E.

Lemma same_winding p k : (k < N)%nat -> choice N B p -> (forall a b, In (a, b) E -> k <> a /\ k <> b) ->
  wind p (p k) = wind q (q k).
Proof.
  intros K P Off.
  assert (M : forall v, continuity (fun s => fst (place N f (path q p s) v)) /\
    continuity (fun s => snd (place N f (path q p s) v))).
  { intros v. unfold place, path, mix. destruct (Nat.ltb v N); simpl; split; reg. }
  assert (Mk : continuity (fun s => fst (path q p s k)) /\ continuity (fun s => snd (path q p s k)))
    by (unfold path, mix; simpl; split; reg).
  destruct round as [R [_ [_ [Le _]]]].
  pose proof (winding_steady E (fun v s => place N f (path q p s) v) (fun s => path q p s k) (rim_closed _ _ R) M Mk)
    as W.
  unfold wind. cbv beta in W. rewrite path_0, path_1 in W.
  assert (P0 : forall v, place N f (path q p 0) v = place N f q v) by (intros; apply place_same, path_0).
  assert (P1 : forall v, place N f (path q p 1) v = place N f p v) by (intros; apply place_same, path_1).
  rewrite (total_same (fun a b => passes (p k) (place N f p a) (place N f p b))
    (fun a b => passes (p k) (place N f (path q p 1) a) (place N f (path q p 1) b))) by (intros; now rewrite !P1).
  rewrite W; [apply total_same; intros; now rewrite !P0 |].
  intros t a b T F. destruct (Le a b F) as [_ [_ Side]]. destruct (Off a b F) as [Ka Kb].
  pose proof (path_choice N B q p t T drawn P) as C. destruct Side as [[A [H [_ Leg]]] | [u U]].
  - rewrite !place_site by assumption. apply (edge_is_free N (path q p t)); auto. now apply (legal_sound N B).
  - rewrite <- (mix_0 (path q p t k) (path q p t k)). apply (not_far (path q p t) k k 0 a b u); auto. lra.
Qed.

Lemma winds_not p k : (k < N)%nat -> choice N B p -> ~ face_corner i L Rest k -> wind p (p k) = 0%Z.
Proof.
  intros K P Nc. rewrite same_winding; auto.
  - destruct round as [R [_ [_ [_ [Tr _]]]]]. apply (rim_around _ E (place N f q) (q k) R). intros a b c F.
    destruct (Tr a b c F) as [O Out]. split; [exact O |].
    apply Out; [exact K | | |]; intros ->; apply Nc; exists a, b, c; auto.
  - intros a b F. destruct (rim_corner a b F). split; intros ->; contradiction.
Qed.

Lemma spoke_out z b : passes z z b = 0%Z.
Proof.
  unfold passes. assert (O : orient z b z = 0) by (unfold orient; ring). rewrite O.
  destruct (right_cases z z) as [[-> _] | [-> X]]; [| lra].
  destruct (right_cases z b) as [[-> _] | [-> _]]; [reflexivity |]. destruct (Rlt_dec 0 0); [lra | reflexivity].
Qed.

Lemma winds p : choice N B p -> wind p (p i) <> 0%Z.
Proof.
  intros P. rewrite same_winding; auto.
  - destruct round as [R [C [Ne [_ [Tr Far]]]]]. unfold wind. set (g := place N f q) in *.
    assert (Gi : g i = q i) by now apply place_site.
    rewrite (rim_total _ _ E (fun a b => passes_back (q i) (g a) (g b)) R), flat_map_app, total_app.
    assert (Z0 : total (fun a b => passes (q i) (g a) (g b)) (flat_map sides Rest) = 0%Z).
    { assert (H : forall a b c, In (a, b, c) Rest -> 0 < orient (g a) (g b) (g c) /\
        ~ (0 <= orient (g a) (g b) (q i) /\ 0 <= orient (g b) (g c) (q i) /\ 0 <= orient (g c) (g a) (q i))).
      { intros a b c F. destruct (Tr a b c) as [O Out]; [apply in_or_app; now right |]. split; [exact O |].
        destruct (Far a b c F) as [X [Y Z]]. apply Out; auto. }
      clear - H. induction Rest as [| [[a b] c] l IH]; [reflexivity |]. simpl flat_map.
      destruct (H a b c (or_introl eq_refl)) as [D O]. pose proof (triangle_around (q i) _ _ _ D O).
      unfold total in *. simpl. rewrite IH by (intros x y w X; apply H; now right). lia. }
    assert (Z1 : total (fun a b => passes (q i) (g a) (g b)) (flat_map sides (map (fun e => (i, fst e, snd e)) L)) =
      total (fun a b => passes (q i) (g a) (g b)) L).
    { clear - Gi. induction L as [| [a b] l IH]; [reflexivity |]. simpl map. simpl flat_map. unfold total in *. simpl.
      rewrite IH, Gi, spoke_out, (passes_back (q i) (q i) (g b)), spoke_out. lia. }
    rewrite Z0, Z1, Z.add_0_r. intros Zero. apply Ne. apply (winds_around L g (q i) C); [| exact Zero].
    intros a b F. destruct (Tr i a b) as [O _]; [apply in_or_app; left; apply in_map_iff; now exists (a, b) |].
    rewrite <- orient_cycle, <- Gi. exact O.
  - intros a b F. destruct round as [_ [_ [_ [Le _]]]]. destruct (Le a b F) as [X [Y _]]. auto.
Qed.

(* From i to a site that is not a corner of its faces: across a legal edge of the rim. *)
Lemma way_out p k : (k < N)%nat -> choice N B p -> ~ face_corner i L Rest k ->
  exists t a b, 0 <= t <= 1 /\ In (a, b) E /\ (a <> i /\ b <> i) /\ ((a < N)%nat /\ (b < N)%nat /\ a <> b /\
    legal N B a b) /\
    between (mix t (p i) (p k)) (p a) (p b).
Proof.
  intros K P Nc. apply NNPP. intros H. apply (winds p P). rewrite <- (winds_not p k K P Nc). symmetry.
  pose proof (winding_steady E (fun v _ => place N f p v) (fun s => mix s (p i) (p k))) as W. cbv beta in W.
    unfold wind.
  rewrite mix_0, mix_1 in W. destruct round as [R [_ [_ [Le _]]]]. apply W.
  - now apply rim_closed in R.
  - intros v. split; apply continuity_const; now intros x y.
  - unfold mix. simpl. split; reg.
  - intros t a b T F. destruct (Le a b F) as [Ai [Bi Side]]. destruct (rim_corner a b F) as [Ca Cb].
    assert (Ka : k <> a) by (intros ->; contradiction). assert (Kb : k <> b) by (intros ->; contradiction).
    destruct Side as [Leg | [u U]].
    + intros X. apply H. exists t, a, b. split; [exact T |]. split; [exact F |]. split; [now split |].
      split; [exact Leg |].
      destruct Leg as [A [C _]]. now rewrite !place_site in X by assumption.
    + apply (not_far p i k t a b u); auto.
Qed.
End Round.

(* ---- the witness ---- *)

Theorem local_witness N B f q i j Li Ri Ei Lj Rj Ej c : choice N B q -> (i < N)%nat -> (j < N)%nat -> i <> j ->
  faces_round N B f q i Li Ri Ei -> faces_round N B f q j Lj Rj Ej ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> face_corner i Li Ri k \/ face_corner j Lj Rj k ->
    dl c (B i) < ds c (B k) /\ dl c (B j) < ds c (B k)) ->
  witness N B i j c.
Proof.
  intros Q I J Dij Fi Fj W k K Ki Kj.
  destruct (classic (face_corner i Li Ri k \/ face_corner j Lj Rj k)) as [C | C]; [now apply W |].
  set (r := Rmax (dl c (B i)) (dl c (B j))). destruct (Rlt_dec r (ds c (B k))) as [Lt | Nlt].
  { split; eapply Rle_lt_trans; try exact Lt; [apply Rmax_l | apply Rmax_r]. }
  exfalso. set (p := set_point q k (nearest c (B k))).
  assert (P : choice N B p) by (apply set_choice; [exact Q | apply nearest_inside]).
  assert (Ci : dist c (p i) <= r) by (eapply Rle_trans; [apply le_dl, (P i I) | apply Rmax_l]).
  assert (Cj : dist c (p j) <= r) by (eapply Rle_trans; [apply le_dl, (P j J) | apply Rmax_r]).
  assert (Ck : dist c (p k) <= r) by (unfold p; rewrite set_same; unfold ds in Nlt; lra).
  assert (Far : forall a, (a < N)%nat -> a <> i -> a <> j -> face_corner i Li Ri a \/ face_corner j Lj Rj a ->
    r < dist c (p a)).
  { intros a A Ai Aj Fa. destruct (W a A Ai Aj Fa). pose proof (ds_le c _ _ (P a A)). unfold r.
    apply Rmax_lub_lt; lra. }
  destruct (way_out N B f q i Li Ri Ei Q I Fi p k K P) as [s [a [b [S [F [[Ai Bi] [[A [H [Ab G]]] X]]]]]]]; [tauto |].
  destruct (way_out N B f q j Lj Rj Ej Q J Fj p k K P) as [t [a' [b' [T [F' [[Aj Bj] [[A' [H' [Ab' G']]] X']]]]]]];
    [tauto |].
  destruct (rim_corner N B f q i Li Ri Ei Fi a b F) as [Va Vb]. 
  destruct (rim_corner N B f q j Lj Rj Ej Fj a' b' F') as [Va' Vb'].
  assert (Ka : k <> a /\ k <> b) by (split; intros ->; tauto).
    assert (Ka' : k <> a' /\ k <> b') by (split; intros ->; tauto).
  apply (legal_sound N B a b p A H) in G; [| exact P]. apply (legal_sound N B a' b' p A' H') in G'; [| exact P].
  assert (Swap : forall z u v, between z u v -> between z v u).
  { intros z u v [m [M Z]]. exists (1 - m). split; [lra |]. rewrite Z. unfold mix. simpl. f_equal; ring. }
  (* the edge is at j, *)
  assert (One : exists b, (b < N)%nat /\ strict_edge N p j b /\ r < dist c (p b) /\
    between (mix s (p i) (p k)) (p j) (p b)).
  { destruct (Nat.eq_dec a j) as [-> | Naj]; [| destruct (Nat.eq_dec b j) as [-> | Nbj]].
    - exists b. split; [exact H |]. split; [exact G |]. split; [apply Far; auto | exact X].
    - exists a. split; [exact A |]. split; [now apply legal_apart |]. split; [apply Far; auto | now apply Swap].
    - exfalso. apply (edge_aside N p a b i k c r s A H I K G); auto; try tauto; apply Far; auto. }
  assert (Two : exists b, (b < N)%nat /\ strict_edge N p i b /\ r < dist c (p b) /\
    between (mix t (p j) (p k)) (p i) (p b)).
  { destruct (Nat.eq_dec a' i) as [-> | Nai]; [| destruct (Nat.eq_dec b' i) as [-> | Nbi]].
    - exists b'. split; [exact H' |]. split; [exact G' |]. split; [apply Far; auto | exact X'].
    - exists a'. split; [exact A' |]. split; [now apply legal_apart |]. split; [apply Far; auto | now apply Swap].
    - exfalso. apply (edge_aside N p a' b' j k c r t A' H' J K G'); auto; try tauto; apply Far; auto. }
  destruct One as [u [U [Gu [Cu Xu]]]]. destruct Two as [v [V [Gv [Cv Xv]]]].
  apply (two_crossings N p i j k u v c r s t); auto.
Qed.
